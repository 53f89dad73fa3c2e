// How sure of a velocity it is said to be. The filter's own deviation is that of its measurements,
// and does not know that a young track has the speed of what came into view, nor that of a near one
// both ends are hidden: of the errors of cars that are nearer than 8 m half lie beyond two of it.
#pragma once

#include <algorithm>
#include <cstdint>

#include "objects/plane.hpp"
#include "objects/rules.hpp"
#include "objects/track.hpp"

namespace iog::objects {

// A deviation of the filter, mm/s, as it is stated: times 1 + kStatedAgeMs / age, and of what is
// nearer than kStatedNearMm to the car times kStatedNear at least.
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
