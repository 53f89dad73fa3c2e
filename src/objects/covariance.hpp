// How sure a track is of its place and its speed along one axis, and what a measurement changes:
// Kalman's filter of a place that moves with a speed that wanders (Bar-Shalom, Li, Kirubarajan,
// "Estimation with applications to tracking and navigation", 2001, section 6.2).
#pragma once

#include <cstdint>

#include "objects/rules.hpp"
#include "objects/step.hpp"

namespace iog::objects {

// Every entry is within +-kMost. The variances are kLeastVariance at least once they are predicted
// or measured.
class Covariance {
 public:
  static constexpr std::int32_t kMost = 2'000'000'000;

  // How much of an innovation the place and the speed take over, in 2^-16; the speed per second.
  // 0 <= place <= 2^16.
  struct Gain {
    std::int32_t place = 0;
    std::int32_t speed = 0;
  };

  constexpr Covariance() = default;
  constexpr Covariance(std::int32_t place, std::int32_t both, std::int32_t speed)
      : place_(place), both_(both), speed_(speed) {}

  [[nodiscard]] constexpr std::int32_t place() const { return place_; }  // mm^2
  [[nodiscard]] constexpr std::int32_t both() const { return both_; }    // mm^2/s
  [[nodiscard]] constexpr std::int32_t speed() const { return speed_; }  // (mm/s)^2

  // A step later, with a speed that has wandered by `wander` mm/s per root of a second.
  void predict(Step step, std::int32_t wander);

  // After a measurement of the place. 0 < variance < 2^31.
  Gain measure(std::int32_t variance);

 private:
  std::int32_t place_ = 0;
  std::int32_t both_ = 0;
  std::int32_t speed_ = 0;
};

}  // namespace iog::objects
