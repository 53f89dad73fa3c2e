// What is wrong with a description: one field, and what it may hold.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::vehicle {

struct Fault {
  static constexpr std::size_t kCar = static_cast<std::size_t>(-1);

  std::size_t sensor = kCar;  // by its number; kCar: a field of the car itself
  std::string_view field;     // as in a car's file: "udp_port", "mount.yaw_deg"
  std::string_view allowed;   // "1 ... 65535"
  std::uint64_t sum = 0;      // what is too much, where several fields make it together; else 0
};

// Every check is a function that calls tell(Fault) for each fault it finds. It is written so that
// what is no number (NaN) is a fault, too.
template <typename Number>
constexpr bool is_within(Number value, Number least, Number most) {
  return value >= least && value <= most;
}

}  // namespace iog::vehicle
