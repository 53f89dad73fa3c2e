// The recursive set S_epsilon, and the quantisation of a probability to an element of this set
// (docs/model.md section 2, thesis section 3.3.3).
//
// The probabilities of the set are `p_n = 1 / (1 + ((1/2 - epsilon) / (1/2 + epsilon))^n)`. The
// log-odds of p_n are n times the log-odds of p_1, so fusing probabilities means adding their
// indexes.
#pragma once

#include <cstdint>

#include "numeric/elementary.hpp"

namespace iog::index {

// The rounding of a probability that lies between two elements of the set (thesis section 3.4.4.1).
enum class Quantisation : std::uint8_t {
  kBlurring,  // towards 1/2: never overstates a sensor's certainty
  kNearest,   // to the element whose probability is nearest; ties are rounded towards 1/2
};

class RecursiveSet {
 public:
  // `epsilon` is the difference between p_1 and 1/2. `epsilon` must be above 0 and below 1/2.
  constexpr explicit RecursiveSet(double epsilon) : ratio_((0.5 - epsilon) / (0.5 + epsilon)) {}

  // Returns p_n, for |n| up to a few million.
  [[nodiscard]] constexpr double probability(std::int32_t n) const {
    return 1 / (1 + power(ratio_, n));
  }

  // Returns the index that represents a probability. The probability must be above 0 and below 1.
  [[nodiscard]] constexpr std::int32_t quantise(double probability, Quantisation policy) const {
    const std::int32_t below = floor_index(probability);
    const std::int32_t above = below + 1;
    if (policy == Quantisation::kBlurring) {
      const bool is_element = this->probability(below) == probability;
      return (probability >= 0.5 || is_element) ? below : above;
    }
    const double to_below = probability - this->probability(below);
    const double to_above = this->probability(above) - probability;
    if (to_below == to_above) {
      return probability < 0.5 ? above : below;
    }
    return to_below < to_above ? below : above;
  }

 private:
  // Returns the n for which `p_n <= probability < p_(n+1)`. The function estimates n from the
  // log-odds, and then corrects the estimate by comparison.
  [[nodiscard]] constexpr std::int32_t floor_index(double probability) const {
    const double estimate = numeric::log(probability / (1 - probability)) / -numeric::log(ratio_);
    auto n = static_cast<std::int32_t>(estimate);
    while (this->probability(n) > probability) {
      --n;
    }
    while (this->probability(n + 1) <= probability) {
      ++n;
    }
    return n;
  }

  // Computes base^n by repeated squaring.
  static constexpr double power(double base, std::int32_t n) {
    double square = n < 0 ? 1 / base : base;
    double result = 1;
    for (std::uint32_t rest = static_cast<std::uint32_t>(n < 0 ? -n : n); rest != 0; rest /= 2) {
      if (rest % 2 == 1) {
        result *= square;
      }
      square *= square;
    }
    return result;
  }

  double ratio_;
};

}  // namespace iog::index
