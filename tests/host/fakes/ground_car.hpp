// A vehicle of the tests, some of whose sensors follow the ground or say what opens it.
#pragma once

#include <vector>

#include "ground/ground.hpp"
#include "lidar/formats.hpp"
#include "vehicle/derived.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tests {

class GroundCar {
 public:
  // All of its sensors that turn follow the ground, if there are limits, and all say what opens it.
  explicit GroundCar(const vehicle::Vehicle& car, vehicle::GroundLimits limits = {220, 2'200},
                     vehicle::MovedLimits moved = {})
      : sensors_(car.sensors.begin(), car.sensors.end()), vehicle_(car) {
    for (vehicle::Sensor& sensor : sensors_) {
      sensor.ground = lidar::turns(sensor.format) ? limits : vehicle::GroundLimits{};
      sensor.moved = moved;
      vehicle::derive_limits(car.footprint, car.z_min, car.z_max, sensor);
    }
    vehicle_.sensors = sensors_;
    vehicle::derive_rules(sensors_, vehicle_.window);
  }
  GroundCar(const GroundCar&) = delete;
  GroundCar& operator=(const GroundCar&) = delete;

  [[nodiscard]] const vehicle::Vehicle& vehicle() const { return vehicle_; }

 private:
  std::vector<vehicle::Sensor> sensors_;
  vehicle::Vehicle vehicle_;
};

// Of a sensor that follows it.
inline const ground::Ground& ground_of(const ground::Grounds& grounds, std::size_t sensor) {
  return grounds.at(grounds.place_of(sensor).value());
}

}  // namespace iog::tests
