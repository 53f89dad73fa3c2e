// What a source of poses knows at one time, as people write it: metres, radians, seconds.
#pragma once

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

}  // namespace iog::tools
