// Predicts and interpolates poses using integer arithmetic (docs/spec.md, section 5.4).
#pragma once

#include <cstdint>

#include "pose/pose.hpp"

namespace iog::pose {

// The speed and the yaw rate are within the limits of pose/limits.hpp.
struct Motion {
  std::int32_t speed_mm_per_s = 0;
  std::int32_t yaw_urad_per_s = 0;
};

// Returns the pose after the motion has continued for elapsed_us <= 10^6, along the chord of the
// circle. The direction of the chord is the heading after half of this time. Requires |x|, |y| <=
// 10^9 mm. The angle is accurate to 2^-32 turns plus one part in 10^9. The position is accurate to
// half a millimetre. The length of the arc is used as the length of the chord. For example, at 0.5
// rad/s and 100 ms, the chord is too long by one part in ten thousand.
[[nodiscard]] Pose moved(const Pose& pose, const Motion& motion, std::uint64_t elapsed_us);

// Interpolates linearly between two poses that are span_us apart. Returns the pose at elapsed_us
// after `from`. The heading turns through the smaller of the two possible angles. If both angles
// are equal, the heading turns clockwise. Requires 0 <= elapsed_us <= span_us, 0 < span_us <= 10^6
// and |x|, |y| <= 10^9 mm. Coordinates are rounded to the nearest integer, and ties are rounded up.
[[nodiscard]] Pose between(const Pose& from, const Pose& to, std::uint64_t elapsed_us,
                           std::uint64_t span_us);

// The difference between two poses in x, y and heading. The difference of the headings is the
// smaller of the two possible angles.
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

// Returns true if a sum of up to 2^20 residuals exceeds kMaxResidualMm, or the equivalent angle at
// kReachMm.
[[nodiscard]] bool is_jump(const Residual& sum);

}  // namespace iog::pose
