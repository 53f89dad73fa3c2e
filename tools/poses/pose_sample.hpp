// What a source of poses knows at one time, as people write it: metres, radians, seconds.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "pose/message.hpp"

namespace iog::tools {

inline constexpr double kRadians = std::numbers::pi / 180;  // of a degree

struct PoseSample {
  std::uint64_t time_us = 0;  // of the measurement, by the source's clock
  std::uint32_t age_us = 0;   // from then until it was sent
  std::uint32_t run = 1;      // of the source
  double x_m = 0;             // of the vehicle frame's origin, in the local frame
  double y_m = 0;
  double heading_rad = 0;   // counter-clockwise from the local frame's x
  double speed_mps = 0;     // along the heading
  double yaw_rate_rps = 0;  // radians a second, counter-clockwise
  // Standard deviations of the motion during the second before: on each axis, and of the heading.
  double sigma_m = 0;
  double sigma_heading_rad = 0;
  std::optional<pose::MapTransform> map{};  // empty: not known
};

// At a time between two samples: it moves and turns evenly, and is no surer than either.
[[nodiscard]] inline PoseSample between(const PoseSample& from, const PoseSample& to,
                                        std::uint64_t time_us) {
  const double part =
      static_cast<double>(time_us - from.time_us) / static_cast<double>(to.time_us - from.time_us);
  const double turn = std::remainder(to.heading_rad - from.heading_rad, 2 * std::numbers::pi);
  PoseSample sample = from;
  sample.time_us = time_us;
  sample.x_m += (to.x_m - from.x_m) * part;
  sample.y_m += (to.y_m - from.y_m) * part;
  sample.heading_rad += turn * part;
  sample.speed_mps += (to.speed_mps - from.speed_mps) * part;
  sample.yaw_rate_rps += (to.yaw_rate_rps - from.yaw_rate_rps) * part;
  sample.sigma_m = std::max(from.sigma_m, to.sigma_m);
  sample.sigma_heading_rad = std::max(from.sigma_heading_rad, to.sigma_heading_rad);
  return sample;
}

}  // namespace iog::tools
