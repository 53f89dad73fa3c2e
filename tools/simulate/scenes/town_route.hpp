// A way along the roads of a map for a simulated car.
#pragma once

#include <vector>

#include "tools/map/geo_map.hpp"
#include "tools/map/polygon.hpp"
#include "tools/poses/map_origin.hpp"
#include "tools/simulate/world/road.hpp"

namespace iog::tools {

struct TownRoute {
  std::vector<Road::Point> points;  // of the map's plane, metres, Road::kStep apart
  std::size_t start = 0;            // where the drive begins
  double width_m = 0;               // of the narrowest road between start and end
};

// Begins on a road near the plane's origin and goes on for ahead_m, where roads meet on the one
// that turns least. Behind the start it has what there is of behind_m. Corners are rounded off over
// some 20 m, as a car takes them, and both ends go straight on for another kSight. UsageError if no
// road within 500 m of the origin leads that far.
[[nodiscard]] TownRoute town_route(const GeoMap& map, const MapOrigin& origin, double ahead_m,
                                   double behind_m);

}  // namespace iog::tools
