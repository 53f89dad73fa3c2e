// A scene's plan as somebody has drawn it for a map: with errors that are stated.
//
// Each kind of error has random numbers of its own, so that one is the same whatever the others
// are. Shares are met to the nearest house or road, not on average.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/simulate/world/scene.hpp"
#include "tools/simulate/world/site_plan.hpp"

namespace iog::tools {

struct MapErrors {
  double shift_east_m = 0;  // of the whole map, in its plane
  double shift_north_m = 0;
  double noise_m = 0;        // standard deviation of a house's place, on each axis
  double missing = 0;        // share of the houses that are left out
  std::uint32_t ghosts = 0;  // houses that do not exist: by turns beside a road and on one
  double outdated = 0;       // share of the drawn houses that have another outline
  double no_width = 0;       // share of the roads that are drawn without their width
};

enum class HouseDrawn : std::uint8_t { kAsItIs, kOutdated, kGhostBeside, kGhostOnRoad };

struct DrawnHouse {
  PlannedHouse house;  // in the scene's world, before the shift of the whole map
  HouseDrawn how = HouseDrawn::kAsItIs;
};

struct DrawnRoad {
  PlannedRoad road;
  bool has_width = true;
};

struct DrawnMap {
  MapErrors errors;
  std::uint64_t seed = 0;
  std::vector<DrawnRoad> roads;
  std::vector<DrawnHouse> houses;
  std::vector<PlannedHouse> missing;  // what was left out
};

// Houses that are outdated are 0.6 to 1.4 times as long and as wide, and up to 2 m beside their
// place on each axis. Ghosts stand within 40 m of where the car drives: on free ground, which is
// neither road nor house, or with their middle on the middle of a road. UsageError if there is no
// free ground for one.
[[nodiscard]] DrawnMap drawn_map(const Scene& scene, const MapErrors& errors, std::uint64_t seed,
                                 double drive_s);

}  // namespace iog::tools
