// Selects one of the two returns of a beam. Some units send the two returns in separate blocks.
#pragma once

#include <algorithm>
#include <cstdint>

namespace iog::lidar {

// The nearer return is the first echo (0), and the farther return is the second echo (1),
// regardless of their order in the packet. If a beam has only one return, both blocks contain it,
// and there is no second echo.
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
