// Looks up the sine and cosine of an integer angle in a table.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "numeric/elementary.hpp"

namespace iog::numeric {

// All sines and cosines are in units of 2^-30.
inline constexpr int kSineFractionBits = 30;

// Computes the sine table of the first quadrant. The table has kTicksPerTurn / 4 + 1 values, each
// rounded to the nearest multiple of 2^-30.
template <std::int32_t kTicksPerTurn>
consteval auto make_sine_quadrant() {
  static_assert(kTicksPerTurn > 0 && kTicksPerTurn % 4 == 0);
  constexpr auto kSize = static_cast<std::size_t>(kTicksPerTurn) / 4 + 1;
  std::array<std::int32_t, kSize> quadrant{};
  for (std::int32_t tick = 0; tick <= kTicksPerTurn / 4; ++tick) {
    quadrant[static_cast<std::size_t>(tick)] = static_cast<std::int32_t>(
        round(sin_first_quadrant(2 * kPi * tick / kTicksPerTurn) * (1 << kSineFractionBits)));
  }
  return quadrant;
}

template <std::int32_t kTicksPerTurn>
inline constexpr auto kSineQuadrant = make_sine_quadrant<kTicksPerTurn>();

// Provides sines and cosines for a full turn from a table of one quadrant.
class SineTable {
 public:
  constexpr SineTable() = default;
  explicit constexpr SineTable(std::span<const std::int32_t> quadrant) : quadrant_(quadrant) {}

  [[nodiscard]] constexpr std::uint32_t ticks_per_turn() const {
    return static_cast<std::uint32_t>(quadrant_.size() - 1) * 4;
  }

  // Requires 0 <= ticks <= ticks_per_turn() - 1.
  [[nodiscard]] constexpr std::int32_t sine(std::uint32_t ticks) const {
    const std::uint32_t quarter = ticks_per_turn() / 4;
    if (ticks <= quarter) {
      return quadrant_[ticks];
    }
    if (ticks <= 2 * quarter) {
      return quadrant_[2 * quarter - ticks];
    }
    return ticks <= 3 * quarter ? -quadrant_[ticks - 2 * quarter] : -quadrant_[4 * quarter - ticks];
  }

  [[nodiscard]] constexpr std::int32_t cosine(std::uint32_t ticks) const {
    const std::uint32_t quarter = ticks_per_turn() / 4;
    return sine(ticks < 3 * quarter ? ticks + quarter : ticks - 3 * quarter);
  }

 private:
  std::span<const std::int32_t> quadrant_{};
};

template <std::int32_t kTicksPerTurn>
inline constexpr SineTable kSineTable{kSineQuadrant<kTicksPerTurn>};

}  // namespace iog::numeric
