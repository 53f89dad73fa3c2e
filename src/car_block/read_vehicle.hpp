// Reads a vehicle from the bytes that car_block/content.hpp writes.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "car_block/record.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::car_block {

// Memory for the sensors of a vehicle, 80 KB: make it static. A constructor sets the initial
// values, which are not zero, so the image need not contain them.
struct SensorMemory {
  SensorMemory();
  std::array<vehicle::Sensor, vehicle::kMaxSensors> sensors;
};

// Returns kNone, kOtherGrid or kNotACar. The vehicle refers to the bytes and to the memory. Do not
// use it before its limits are checked (car_block/limits.hpp). Azimuths are derived here, other
// derived members are not.
[[nodiscard]] Refusal read_vehicle(std::span<const std::byte> content, SensorMemory& memory,
                                   vehicle::Vehicle& vehicle);

}  // namespace iog::car_block
