// Reads a vehicle from its serialised form (car_block/content.hpp).
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
// `memory`, so both must outlive `vehicle`. Check `vehicle` against the limits
// (car_block/limits.hpp) before using it. The only derived members that this function sets are the
// azimuths.
[[nodiscard]] Refusal read_vehicle(std::span<const std::byte> content, SensorMemory& memory,
                                   vehicle::Vehicle& vehicle);

}  // namespace iog::car_block
