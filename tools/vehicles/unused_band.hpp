// Warns of a height band that no sensor uses.
#pragma once

#include <string>

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// A line if each sensor of the car follows the ground and z_min_m or z_max_m differs from what the
// car would have without these keys. Empty otherwise, and if z_max_m is a sensor's top_m.
[[nodiscard]] std::string warning_of_unused_band(const CatalogueEntry& car);

}  // namespace iog::tools
