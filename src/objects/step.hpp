// The time between two successive frames.
#pragma once

#include <cstdint>

#include "objects/rules.hpp"

namespace iog::objects {

// A step lasts from 1 ms to kLongestStepMs.
class Step {
 public:
  explicit constexpr Step(std::int32_t ms) : ms_(ms), seconds_((ms << 16) / 1000) {}

  [[nodiscard]] constexpr std::int32_t ms() const { return ms_; }

  // Returns the change during the step for a given change per second, rounded down. The absolute
  // value of `per_second` must be below 2^48.
  [[nodiscard]] constexpr std::int64_t of(std::int64_t per_second) const {
    return (per_second * seconds_) >> 16;
  }

 private:
  std::int32_t ms_;
  std::int32_t seconds_;  // in units of 2^-16, at most 0.45
};

}  // namespace iog::objects
