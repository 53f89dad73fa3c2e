// Rounds the azimuths of a sensor to steps (docs/model.md section 5).
//
// Azimuths are measured in ticks, and a turn has T ticks. An azimuth of t ticks is rounded to the
// nearest of N steps, with ties rounded up:
//     floor(t * N / T + 1 / 2).
// If the result is a full turn, the step is 0. If N = T, the steps are the ticks.
//
// The code needs only one 32 x 32-bit multiplication. Let s be the largest number for which m =
// ceil(2^(16 + s) * N / T) < 2^32. Then the value of
//     floor((2^16 * t * m + 2^(31 + s)) / 2^(32 + s))
// equals the expression above. Proof: m is too large by less than 1, so the quotient is too large
// by less than t / 2^(16 + s). Let T' = T / gcd(T, N). Before rounding down, the exact value is a
// multiple of 1 / (2 * T'). The error therefore has no effect if (T - 1) * 2 * T' <= 2^(16 + s).
// The function is_valid() checks that this condition is met and that no word overflows.
#pragma once

#include <cstdint>
#include <numeric>

namespace iog::vehicle {

class AzimuthSteps {
 public:
  constexpr AzimuthSteps() = default;
  // Both arguments must be above 0 and below 2^30.
  constexpr AzimuthSteps(std::uint32_t ticks_per_turn, std::uint32_t steps_per_turn)
      : ticks_per_turn_(ticks_per_turn), steps_per_turn_(steps_per_turn), shift_(1) {
    while (std::uint64_t{steps_per_turn} << (17 + shift_) < std::uint64_t{ticks_per_turn} << 32) {
      ++shift_;
    }
    factor_ = static_cast<std::uint32_t>(
        ((std::uint64_t{steps_per_turn} << (16 + shift_)) + ticks_per_turn - 1) / ticks_per_turn);
    half_ = std::uint32_t{1} << (shift_ - 1);
  }

  [[nodiscard]] constexpr bool is_valid() const {
    const std::uint64_t last = ticks_per_turn_ - 1;
    const std::uint64_t parts =
        std::uint64_t{2} * (ticks_per_turn_ / std::gcd(ticks_per_turn_, steps_per_turn_));
    return last < 1U << 16 && last * parts <= std::uint64_t{1} << (16 + shift_) &&
           last * factor_ + (std::uint64_t{half_} << 16) < std::uint64_t{1} << 48;
  }

  [[nodiscard]] constexpr std::uint32_t ticks_per_turn() const { return ticks_per_turn_; }
  [[nodiscard]] constexpr std::uint32_t steps_per_turn() const { return steps_per_turn_; }

  // Returns the nearest step, from 0 to steps_per_turn() - 1. `azimuth_ticks` must be less than one
  // turn.
  [[nodiscard]] constexpr std::uint32_t nearest(std::uint32_t azimuth_ticks) const {
    const std::uint64_t sum =
        std::uint64_t{azimuth_ticks << 16} * factor_ + (std::uint64_t{half_} << 32);
    const std::uint32_t step = static_cast<std::uint32_t>(sum >> 32) >> shift_;
    return step == steps_per_turn_ ? 0 : step;
  }

 private:
  std::uint32_t ticks_per_turn_ = 1;
  std::uint32_t steps_per_turn_ = 1;
  int shift_ = 15;
  std::uint32_t factor_ = std::uint32_t{1} << 31;
  std::uint32_t half_ = std::uint32_t{1} << 14;
};

}  // namespace iog::vehicle
