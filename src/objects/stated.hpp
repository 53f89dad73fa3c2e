// Computes the reported standard deviation of a velocity. The filter's own standard deviation
// covers only measurement errors. The filter does not take into account that the visible part of a
// young object changes or that both ends of a near object may be hidden. For cars within 8 m, half
// of the errors exceed twice the filter's standard deviation.
#pragma once

#include <algorithm>
#include <cstdint>

#include "objects/plane.hpp"
#include "objects/rules.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// Multiplies `deviation`, the filter's standard deviation in mm/s, by 1 + kStatedAgeMs / age, where
// `age` is the age of the track in ms. If the object is less than kStatedNearMm away from the car,
// the factor is at least kStatedNear.
[[nodiscard]] inline std::uint32_t stated_deviation(std::uint32_t deviation, const Track& track,
                                                    std::uint64_t now_us, Point car) {
  const std::uint64_t age_ms =
      std::max<std::uint64_t>((now_us - std::min(now_us, track.born_us)) / 1000, 1);
  const std::uint64_t by_age = (deviation * (age_ms + kStatedAgeMs) + age_ms - 1) / age_ms;
  const bool is_near = range_mm(car, track.box().at) < kStatedNearMm;
  const std::uint64_t by_range = is_near ? std::uint64_t{deviation} * kStatedNear : 0;
  return static_cast<std::uint32_t>(
      std::min<std::uint64_t>(std::max(by_age, by_range), kMostSpeed));
}

}  // namespace iog::objects
