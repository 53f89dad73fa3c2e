// A copy of a car's tables to change, and which limit they break then.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "car_block/limits.hpp"
#include "vehicles/cars.hpp"

namespace iog::tests {

struct Changed {
  explicit Changed(const vehicles::Car& from)
      : sensors(from.vehicle.sensors.begin(), from.vehicle.sensors.end()),
        car(from.vehicle),
        network(from.network) {
    car.sensors = sensors;
  }
  // "2.udp_port", "name"; empty: none
  [[nodiscard]] std::string fault() const {
    const vehicle::Fault fault = car_block::fault_of(car, network);
    const bool is_of_car = fault.sensor == vehicle::Fault::kCar;
    return (is_of_car ? "" : std::to_string(fault.sensor) + ".") + std::string(fault.field);
  }

  std::vector<vehicle::Sensor> sensors;
  vehicle::Vehicle car;
  net::Config network;
};

template <typename Change>
std::string fault_with(Change&& change, std::string_view name = "reference_car") {
  Changed changed(vehicles::car(name));
  change(changed);
  return changed.fault();
}

}  // namespace iog::tests
