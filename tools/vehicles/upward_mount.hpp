// A sensor whose mount looks up, which a sign that is wrong makes of one that looks down.
#pragma once

#include <string>

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// A line for each sensor that is pitched up by more than 5 degrees. Empty if there is none.
[[nodiscard]] std::string warning_of_upward_mounts(const CatalogueEntry& car);

}  // namespace iog::tools
