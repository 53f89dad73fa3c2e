// Prediction and interpolation of poses, in integers (docs/spec.md, section 5.4).
#pragma once

#include <cstdint>

#include "pose/pose.hpp"

namespace iog::pose {

// Within the limits of pose/limits.hpp.
struct Motion {
  std::int32_t speed_mm_per_s = 0;
  std::int32_t yaw_urad_per_s = 0;
};

// The pose after driving on for elapsed_us <= 10^6, along the chord of the circle. The direction of
// the chord is the heading at half time. |x|, |y| <= 10^9 mm. The angle is accurate to 2^-32 turns
// plus one part in 10^9, the position to half a millimetre. The chord is taken to be as long as its
// arc, which is one part in ten thousand too long at 0.5 rad/s and 100 ms.
[[nodiscard]] Pose moved(const Pose& pose, const Motion& motion, std::uint64_t elapsed_us);

// Linear interpolation between two poses at elapsed_us of span_us. The heading turns the shorter
// way round; if both are equally long, clockwise. 0 <= elapsed_us <= span_us, 0 < span_us <= 10^6,
// |x|, |y| <= 10^9 mm. Coordinates are rounded to the nearest integer; ties round up.
[[nodiscard]] Pose between(const Pose& from, const Pose& to, std::uint64_t elapsed_us,
                           std::uint64_t span_us);

// Difference of two poses by coordinate. Headings differ by the shorter way round.
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

// Whether a sum of up to 2^20 residuals exceeds kMaxResidualMm, or as much at kReachMm.
[[nodiscard]] bool is_jump(const Residual& sum);

}  // namespace iog::pose
