// Of captures, where several units may send to a sensor's port.
#pragma once

#include <cstddef>
#include <cstdint>
#include <set>

#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {

// Knows the strangers on the ports of a car whose file names the senders (`source_ipv4`). What was
// recorded elsewhere has other addresses, so nobody is a stranger until the named sender was heard.
class NamedSenders {
 public:
  explicit NamedSenders(const CatalogueEntry& car) : car_(&car) {}

  [[nodiscard]] bool is_stranger(std::uint32_t source_ipv4, std::uint16_t udp_port) {
    const std::size_t sensor = sensor_of_port(*car_, udp_port);
    if (sensor == car_->sensors.size() || car_->sensors[sensor].source_ipv4 == 0) {
      return false;
    }
    const bool is_named = car_->sensors[sensor].source_ipv4 == source_ipv4;
    if (is_named) {
      heard_.insert(sensor);
    }
    const bool is_stranger = !is_named && heard_.contains(sensor);
    strangers_ += is_stranger ? 1U : 0U;
    return is_stranger;
  }

  // How many packets of theirs have come.
  [[nodiscard]] std::size_t strangers() const { return strangers_; }

 private:
  const CatalogueEntry* car_;
  std::set<std::size_t> heard_;  // sensors of the car
  std::size_t strangers_ = 0;
};

}  // namespace iog::tools
