// The time of day of this PC.
#pragma once

#include <chrono>
#include <cstdint>

namespace iog::tools {

// Microseconds since 1970.
[[nodiscard]] inline std::uint64_t time_of_day_us() {
  using std::chrono::microseconds;
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return static_cast<std::uint64_t>(std::chrono::duration_cast<microseconds>(now).count());
}

}  // namespace iog::tools
