// Sixteen adjacent occupancy indexes, with saturating arithmetic.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace iog::lanes {

inline constexpr std::size_t kLaneCount = 16;

// Sixteen bytes in memory.
struct LaneBytes {
  alignas(kLaneCount) std::array<std::int8_t, kLaneCount> bytes{};
  friend constexpr bool operator==(const LaneBytes&, const LaneBytes&) = default;
};

// The scalar reference for subtract() and add() in all Lanes classes. Values saturate at -128 and
// 127.
[[nodiscard]] constexpr std::int8_t saturated(int value) {
  return static_cast<std::int8_t>(value < -128 ? -128 : value > 127 ? 127 : value);
}
[[nodiscard]] constexpr std::int8_t subtract_saturated(std::int8_t minuend, std::int8_t amount) {
  return saturated(minuend - amount);
}
[[nodiscard]] constexpr std::int8_t add_saturated(std::int8_t a, std::int8_t b) {
  return saturated(a + b);
}

}  // namespace iog::lanes
