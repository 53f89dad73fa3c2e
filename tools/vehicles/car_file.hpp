// A car as its file describes it (docs/vehicles.md): TOML, read without a compiler.
#pragma once

#include <deque>
#include <string>
#include <vector>

#include "net/config.hpp"
#include "tools/vehicles/toml_table.hpp"
#include "vehicle/description.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {

// A description with all that it points to.
struct Car {
  std::deque<std::string> names;                 // of the car and of its sensors
  std::deque<std::vector<lidar::Laser>> lasers;  // of its calibrated sensors
  vehicle::Description description;
  std::vector<vehicle::SensorConfig> sensors;
  net::Config network{};
  std::vector<vehicle::Sensor> tables;  // of the sensors, in their order
  vehicle::Vehicle vehicle;             // what the target would know of it

  Car() = default;
  Car(Car&&) = default;
  Car& operator=(Car&&) = default;
  Car(const Car&) = delete;
  Car& operator=(const Car&) = delete;
  ~Car() = default;
};

// A description that keeps to all its limits, with its tables. UsageError with every mistake of the
// file, a line each: "car.toml:12: sensors[0].udp_port: allowed is ...".
[[nodiscard]] Car read_car(const std::string& path);

}  // namespace iog::tools
