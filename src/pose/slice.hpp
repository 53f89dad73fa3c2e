// Divides the time of the pose source into slices. All data measured in a slice is registered with
// the pose at the middle of the slice, so the order and the grouping of packets do not matter.
#pragma once

#include <cstdint>

namespace iog::pose {

struct Slice {
  std::uint64_t number = 0;     // from the zero of the clock
  std::uint64_t middle_us = 0;  // time of the pose that registers it
  std::uint64_t end_us = 0;     // start of the next slice
  friend constexpr bool operator==(const Slice&, const Slice&) = default;
};

class Slicing {
 public:
  // `log2_ms` is in the range 0 to 6. A slice is 2^log2_ms milliseconds long.
  explicit constexpr Slicing(std::uint8_t log2_ms = 3) : log2_ms_{log2_ms} {}

  [[nodiscard]] constexpr std::uint64_t slice_us() const { return std::uint64_t{1000} << log2_ms_; }

  // Returns the slice that contains a time. A slice includes its start, but not its end. The middle
  // and the end of a slice wrap around at 2^64 us.
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
