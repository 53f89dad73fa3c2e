// The covariance of position and speed along one axis. In the motion model of the Kalman filter,
// the speed is a random walk (Bar-Shalom, Li, Kirubarajan, "Estimation with applications to
// tracking and navigation", 2001, section 6.2).
#pragma once

#include <cstdint>

#include "objects/rules.hpp"
#include "objects/step.hpp"

namespace iog::objects {

// The absolute value of every entry is at most kMost. After predict() or measure(), the variances
// are at least kLeastVariance.
class Covariance {
 public:
  static constexpr std::int32_t kMost = 2'000'000'000;

  // The Kalman gains for the position and the speed. `place` is in units of 2^-16 and ranges from 0
  // to 2^16. `speed` is in units of 2^-16 per second.
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

  // Predicts the covariance after one step. `wander` is the process noise in mm/s per root second.
  void predict(Step step, std::int32_t wander);

  // Updates the covariance after a measurement of the position. Requires 0 < variance < 2^31.
  Gain measure(std::int32_t variance);

 private:
  std::int32_t place_ = 0;
  std::int32_t both_ = 0;
  std::int32_t speed_ = 0;
};

}  // namespace iog::objects
