// A vehicle of the tests, some of whose sensors follow the ground.
#pragma once

#include <vector>

#include "ground/ground.hpp"
#include "lidar/formats.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tests {

class GroundCar {
 public:
  // All of its sensors that turn do.
  explicit GroundCar(const vehicle::Vehicle& car, vehicle::GroundLimits limits = {220, 2'200})
      : sensors_(car.sensors.begin(), car.sensors.end()), vehicle_(car) {
    for (vehicle::Sensor& sensor : sensors_) {
      sensor.ground = lidar::turns(sensor.format) ? limits : vehicle::GroundLimits{};
    }
    vehicle_.sensors = sensors_;
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
