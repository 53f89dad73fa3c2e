// A vehicle out of the bytes that car_block/content.hpp writes.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "car_block/record.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::car_block {

// The sensors of a vehicle that was read; 80 KB: belongs into static memory. They do not begin as
// zeros, and an image is not to carry them: code makes them.
struct SensorMemory {
  SensorMemory();
  std::array<vehicle::Sensor, vehicle::kMaxSensors> sensors;
};

// kNone, kOtherGrid or kNotACar. The vehicle refers to the bytes and to the memory, and must not be
// used before its limits have been checked (car_block/limits.hpp). What follows from its members
// is not there yet, but for azimuths.
[[nodiscard]] Refusal read_vehicle(std::span<const std::byte> content, SensorMemory& memory,
                                   vehicle::Vehicle& vehicle);

}  // namespace iog::car_block
