// What stands along the simulated ring road: guard rails and lamps between the carriageways, sign
// gantries, and beside the road in turn noise barriers, banks and open land with trees and houses.
#pragma once

#include <array>
#include <cstdint>

#include "tools/simulate/landscape.hpp"
#include "tools/simulate/road.hpp"

namespace iog::tools {

// The middles of the lanes from the fast to the slow one, in metres from the centre line.
inline constexpr std::array kRingRoadLanes{4.75, 8.25, 11.75};

// For a drive of that length along that road.
[[nodiscard]] Landscape make_ring_road_verge(const Road& road, std::uint64_t seed, double drive_m);

}  // namespace iog::tools
