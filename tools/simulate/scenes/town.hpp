// A town of a map as a scene: its houses where they stand, a car that drives along its roads, other
// cars, people, and lamp posts where there is room.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>

#include "tools/map/geo_map.hpp"
#include "tools/poses/map_origin.hpp"
#include "tools/simulate/world/map_place.hpp"
#include "tools/simulate/world/scene.hpp"

namespace iog::tools {

struct Town {
  Scene scene;     // without a plan: its map is the one that it was made of
  MapPlace place;  // the scene's world in the plane of that map: moved, not turned
  std::size_t walls = 0;
  std::size_t walls_in_the_way = 0;  // left out: roads are wider on maps than between some houses
};

// For a drive of that many seconds that begins on a road near the plane's origin (without one: the
// middle of the data). Houses are 5 to 15 m high: maps seldom say. The same map, seed and seconds
// make the same town. UsageError as of town_route().
[[nodiscard]] Town make_town(const GeoMap& map, const std::optional<MapOrigin>& origin,
                             std::uint64_t seed, double drive_s);

// "1234 walls of houses, 5 left out because cars would drive through them; plane at 48.41,15.6".
[[nodiscard]] std::string summary_of(const Town& town);

}  // namespace iog::tools
