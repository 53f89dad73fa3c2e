// Whether a capture is one of a vehicle's sensors.
#pragma once

#include <string>

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// Reads as much of the capture as tells whose it is. UsageError with CaptureIdentity::refusal() if
// it cannot be the car's, or if the file cannot be read. What is not a regular file, such as a
// pipe, could be read only once and is left alone.
void demand_fit(const std::string& path, const CatalogueEntry& car);

}  // namespace iog::tools
