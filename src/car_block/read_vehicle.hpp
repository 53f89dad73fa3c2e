// Reads a vehicle from the bytes that car_block/content.hpp writes.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "car_block/record.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::car_block {

// Memory for the sensors of a vehicle. The object must be static because it takes up 80 KB. The
// constructor sets the initial values. These values are not zero, so a static initialiser would add
// them to the image.
struct SensorMemory {
  SensorMemory();
  std::array<vehicle::Sensor, vehicle::kMaxSensors> sensors;
  ageing::Tables tables;  // only for a car with its own evidential constants
};

// Reads a vehicle and returns kNone, kOtherGrid or kNotACar. `vehicle` points into `content` and
// `memory`, so both must outlive `vehicle`. Do not use `vehicle` before its limits are checked
// (car_block/limits.hpp). Of the derived members, the function sets only the azimuths.
[[nodiscard]] Refusal read_vehicle(std::span<const std::byte> content, SensorMemory& memory,
                                   vehicle::Vehicle& vehicle);

}  // namespace iog::car_block
