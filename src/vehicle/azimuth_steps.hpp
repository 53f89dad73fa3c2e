// The azimuths to which a sensor's points are rounded (docs/model.md section 5).
//
// Azimuth t, one of T ticks of a turn, is rounded to the nearest of N steps, a tie upwards:
//     floor(t N / T + 1 / 2) = floor((2 t N' + T') / 2 T')   with N' = N / g, T' = T / g,
// g their greatest common divisor; a whole turn is step 0 again. Where N = T, steps are ticks.
//
// Range: 2 (T - 1) N' + T' < 2^31, which is_valid() says.
#pragma once

#include <cstdint>
#include <numeric>

#include "numeric/reciprocal.hpp"

namespace iog::vehicle {

class AzimuthSteps {
 public:
  constexpr AzimuthSteps() = default;
  // Both are above 0 and below 2^30.
  constexpr AzimuthSteps(std::uint32_t ticks_per_turn, std::uint32_t steps_per_turn)
      : ticks_per_turn_(ticks_per_turn), steps_per_turn_(steps_per_turn) {
    const std::uint32_t divisor = std::gcd(ticks_per_turn, steps_per_turn);
    half_ = ticks_per_turn / divisor;
    factor_ = 2 * (steps_per_turn / divisor);
    whole_ = numeric::Reciprocal(2 * half_);
  }

  [[nodiscard]] constexpr bool is_valid() const {
    return std::uint64_t{ticks_per_turn_ - 1} * factor_ + half_ < std::uint64_t{1} << 31;
  }

  [[nodiscard]] constexpr std::uint32_t ticks_per_turn() const { return ticks_per_turn_; }
  [[nodiscard]] constexpr std::uint32_t steps_per_turn() const { return steps_per_turn_; }

  // The step of an azimuth: 0 ... steps_per_turn() - 1. azimuth_ticks < one turn.
  [[nodiscard]] constexpr std::uint32_t nearest(std::uint32_t azimuth_ticks) const {
    const std::uint32_t step = whole_.divide(azimuth_ticks * factor_ + half_);
    return step - (step == steps_per_turn_ ? step : 0);
  }

 private:
  std::uint32_t ticks_per_turn_ = 1;
  std::uint32_t steps_per_turn_ = 1;
  std::uint32_t factor_ = 2;
  std::uint32_t half_ = 1;
  numeric::Reciprocal whole_{2};
};

}  // namespace iog::vehicle
