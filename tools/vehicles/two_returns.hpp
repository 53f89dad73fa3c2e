// What a unit sends that is set to two returns, beside what its car's file lets a scan have.
#pragma once

#include <cstdint>
#include <string>

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// Of a turn of 100 ms, by when its lasers fire; 0: a unit of this format has no such mode, or none
// that is taken.
[[nodiscard]] std::uint32_t points_with_two_returns(lidar::Format format);

// Whether a packet of the format has two returns of each beam, however the unit is set up.
[[nodiscard]] bool sends_two_returns(lidar::Format format);

// A line for each sensor whose max_points_per_scan is below that: which, and how much of a turn
// would be dropped. Empty if there is none.
[[nodiscard]] std::string warning_of_two_returns(const CatalogueEntry& car);

}  // namespace iog::tools
