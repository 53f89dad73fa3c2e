// Two returns of one beam, as a unit sends them in two blocks.
#pragma once

#include <algorithm>
#include <cstdint>

namespace iog::lidar {

// The nearer return is the first echo (0), whichever block it stands in, and the farther the second
// (1). A beam with one return shows it twice; the second is no echo of its own.
[[nodiscard]] constexpr std::uint32_t range_of_echo(std::uint32_t one, std::uint32_t other,
                                                    std::uint8_t echo) {
  const std::uint32_t nearer = std::min(one, other);
  const std::uint32_t farther = std::max(one, other);
  const bool has_two = nearer != 0 && nearer != farther;
  if (echo == 0) {
    return has_two ? nearer : farther;
  }
  return has_two ? farther : 0;
}

}  // namespace iog::lidar
