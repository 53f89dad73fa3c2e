// Sixteen occupancy indexes beside one another, and what is computed with them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace iog::grid {

inline constexpr std::size_t kLaneCount = 16;

// Sixteen bytes as they lie in memory.
struct LaneBytes {
  alignas(kLaneCount) std::array<std::int8_t, kLaneCount> bytes{};
  friend constexpr bool operator==(const LaneBytes&, const LaneBytes&) = default;
};

// What subtract() of any Lanes computes, lane by lane: the difference, but not below -128.
[[nodiscard]] constexpr std::int8_t subtract_saturated(std::int8_t minuend, std::int8_t amount) {
  const int difference = minuend - amount;
  return static_cast<std::int8_t>(difference < -128 ? -128 : difference > 127 ? 127 : difference);
}

}  // namespace iog::grid
