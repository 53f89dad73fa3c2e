// What stands along the simulated ring road: guard rails and lamps between the carriageways, sign
// gantries, and beside the road in turn noise barriers, banks and open land with trees and houses.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "tools/simulate/world/landscape.hpp"
#include "tools/simulate/world/road.hpp"
#include "tools/simulate/world/site_plan.hpp"

namespace iog::tools {

// The middles of the lanes from the fast to the slow one, in metres from the centre line.
inline constexpr std::array kRingRoadLanes{4.75, 8.25, 11.75};

// A carriageway between the rails: hard strip, three lanes and hard shoulder.
inline constexpr double kCarriagewayMiddle = 8.75;
inline constexpr double kCarriagewayWidth = 14.5;

struct RingRoadVerge {
  Landscape landscape;
  std::vector<PlannedHouse> houses;
};

// For a drive of that length along that road.
[[nodiscard]] RingRoadVerge make_ring_road_verge(const Road& road, std::uint64_t seed,
                                                 double drive_m);

}  // namespace iog::tools
