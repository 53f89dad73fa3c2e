// What a description must keep to so that its tables can be computed, and what they no longer show.
// All else is asked of the integers that it becomes (car_block/limits.hpp).
#pragma once

#include <span>

#include "tools/car/description.hpp"
#include "vehicle/fault.hpp"

namespace iog::description {

// Tells each fault. Fields are those of a car's file.
void check(const Description& car, std::span<const SensorConfig> sensors,
           const vehicle::Tell& tell);

}  // namespace iog::description
