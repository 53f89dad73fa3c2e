// How poses move between messages and beyond the newest, in integers (docs/spec.md, section 5.4).
#pragma once

#include <cstdint>

#include "pose/pose.hpp"

namespace iog::pose {

// Within the bounds of pose/limits.hpp.
struct Motion {
  std::int32_t speed_mm_per_s = 0;
  std::int32_t yaw_urad_per_s = 0;
};

// The pose after driving on for elapsed_us <= 10^6: along the chord of the circle, whose direction
// is the heading at half time. |x|, |y| <= 10^9 mm. The angle turned is to 2^-32 turns and one part
// in 10^9, the position to half a millimetre; the chord is taken as long as its arc, which at 0.5
// rad/s and 100 ms is one part in ten thousand too long.
[[nodiscard]] Pose moved(const Pose& pose, const Motion& motion, std::uint64_t elapsed_us);

// The pose at elapsed_us of span_us on the straight way from one pose to another, the heading by
// the shorter way round (of two that are equally long, clockwise). 0 <= elapsed_us <= span_us, 0 <
// span_us <= 10^6, |x|, |y| <= 10^9 mm. Each coordinate is the nearest integer, a tie upwards.
[[nodiscard]] Pose between(const Pose& from, const Pose& to, std::uint64_t elapsed_us,
                           std::uint64_t span_us);

// How far one pose is off another, coordinate by coordinate, the heading by the shorter way round.
struct Residual {
  std::int64_t x_mm = 0;
  std::int64_t y_mm = 0;
  std::int64_t heading = 0;  // 2^-32 turns
  constexpr Residual& operator+=(const Residual& other) {
    x_mm += other.x_mm;
    y_mm += other.y_mm;
    heading += other.heading;
    return *this;
  }
};

[[nodiscard]] Residual residual(const Pose& pose, const Pose& predicted);

// Whether a sum of up to 2^20 residuals is above kMaxResidualMm, or as much at kReachMm.
[[nodiscard]] bool is_jump(const Residual& sum);

}  // namespace iog::pose
