// A car of vehicles/ with other keys `ground`, `moved` and `objects`, with classes, and with clocks
// that are those of its poses.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "lidar/formats.hpp"
#include "vehicle/derived.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::lab {

struct Keys {
  vehicle::GroundLimits ground{};  // of its units that turn
  vehicle::MovedLimits moved{};
  std::optional<bool> has_objects{};  // none: where no unit turns
};

class KeyedCar {
 public:
  // A LUX scans 25 times a second: whatever the units, a frame is that long.
  static constexpr std::uint32_t kFramePeriodUs = 40'000;

  KeyedCar(const vehicle::Vehicle& car, const Keys& keys) : KeyedCar(car, keys, car.window) {}
  // With other rules of its window.
  KeyedCar(const vehicle::Vehicle& car, const Keys& keys, const perception::Rules& rules)
      : sensors_(car.sensors.begin(), car.sensors.end()), vehicle_(car) {
    for (vehicle::Sensor& sensor : sensors_) {
      sensor.ground = lidar::turns(sensor.format) ? keys.ground : vehicle::GroundLimits{};
      sensor.moved = keys.moved;
      sensor.is_synchronised = true;
      vehicle::derive_limits(car.footprint, car.z_min, car.z_max, sensor);
    }
    vehicle_.sensors = sensors_;
    vehicle_.window = rules;
    vehicle_.grids = vehicle::Grids::kClasses;
    vehicle_.has_objects = keys.has_objects.value_or(std::ranges::none_of(
        sensors_, [](const vehicle::Sensor& sensor) { return lidar::turns(sensor.format); }));
    vehicle_.frame_period_us = kFramePeriodUs;
    vehicle::derive_rules(sensors_, vehicle_.window, vehicle_.grid.cell_mm);
  }
  KeyedCar(const KeyedCar&) = delete;
  KeyedCar& operator=(const KeyedCar&) = delete;

  [[nodiscard]] const vehicle::Vehicle& vehicle() const { return vehicle_; }

 private:
  std::vector<vehicle::Sensor> sensors_;
  vehicle::Vehicle vehicle_;
};

}  // namespace iog::lab
