// What is wrong with a car: one field, and what it may hold.
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
  std::uint32_t least = 0;    // what is allowed begins with "at least" and this; 0: it does not
  std::uint64_t sum = 0;      // what is too much, where several fields make it together; else 0
};

// Whom a check tells of each fault that it finds: whatever can be called with one, and outlives the
// check.
class Tell {
 public:
  template <typename Listener>
  explicit constexpr Tell(Listener& listener)
      : listener_(&listener),
        call_([](void* told, const Fault& fault) { (*static_cast<Listener*>(told))(fault); }) {}

  constexpr void operator()(const Fault& fault) const { call_(listener_, fault); }

 private:
  void* listener_;
  void (*call_)(void* listener, const Fault& fault);
};

// What is no number (NaN) is outside.
template <typename Number>
constexpr bool is_within(Number value, Number least, Number most) {
  return value >= least && value <= most;
}

}  // namespace iog::vehicle
