// The car of a firmware image: put there, checked as the firmware checks it, and in words.
#pragma once

#include <string>

#include "tools/image/firmware_image.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// UsageError if the firmware is made for another grid, or for other grids, than the car.
void put_car(const CatalogueEntry& car, FirmwareImage& image);

// A table for a person. CheckFailed with the firmware's words if it would refuse the car.
[[nodiscard]] std::string words_of_image(const FirmwareImage& image);
void demand_accepted(const FirmwareImage& image);

}  // namespace iog::tools
