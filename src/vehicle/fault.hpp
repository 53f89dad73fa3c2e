// A fault in a car file, with the field and its allowed values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::vehicle {

struct Fault {
  static constexpr std::size_t kCar = static_cast<std::size_t>(-1);

  std::size_t sensor = kCar;  // sensor number, or kCar for a field of the car itself
  std::string_view field;     // name in the car file, such as "udp_port" or "mount.yaw_deg"
  std::string_view allowed;   // "1 ... 65535"
  std::uint32_t least = 0;    // if not 0, the allowed values begin with "at least" and this number
  std::uint64_t sum = 0;      // sum of several fields if their sum is too large, else 0
};

// Reports faults to a listener. A listener is any callable that takes a Fault and outlives the
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

// NaN is outside every interval.
template <typename Number>
constexpr bool is_within(Number value, Number least, Number most) {
  return value >= least && value <= most;
}

}  // namespace iog::vehicle
