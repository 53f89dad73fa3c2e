// Slices of the time of the poses' source: what is measured in one is placed by one pose, that of
// its middle. So neither the order nor the grouping of packets shows.
#pragma once

#include <cstdint>

namespace iog::pose {

struct Slice {
  std::uint64_t number = 0;     // since the clock's zero
  std::uint64_t middle_us = 0;  // whose pose places it
  std::uint64_t end_us = 0;     // where the next one begins
  friend constexpr bool operator==(const Slice&, const Slice&) = default;
};

class Slicing {
 public:
  // A slice is 2^log2_ms milliseconds long. log2_ms: 0 ... 6.
  explicit constexpr Slicing(std::uint8_t log2_ms = 3) : log2_ms_{log2_ms} {}

  [[nodiscard]] constexpr std::uint64_t slice_us() const { return std::uint64_t{1000} << log2_ms_; }

  // The slice that holds a time, its beginning included. A middle or an end beyond 2^64 us wraps.
  [[nodiscard]] constexpr Slice slice_of(std::uint64_t time_us) const {
    const std::uint64_t number = time_us / slice_us();
    const std::uint64_t first_us = number * slice_us();
    return {
        .number = number, .middle_us = first_us + slice_us() / 2, .end_us = first_us + slice_us()};
  }

 private:
  std::uint8_t log2_ms_;
};

}  // namespace iog::pose
