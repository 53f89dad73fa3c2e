// Warns of a mount that looks up: a wrong sign turns a downward mount into one.
#pragma once

#include <string>

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// A line for each sensor that is pitched up by more than 5 degrees. Empty if there is none.
[[nodiscard]] std::string warning_of_upward_mounts(const CatalogueEntry& car);

}  // namespace iog::tools
