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

// Returns the pose after moving for elapsed_us. The circular arc is replaced by a chord, whose
// direction is the heading after half of this time. Requires `elapsed_us <= 10^6`. The magnitudes
// of x and y must be at most 10^9 mm. The change in heading is accurate to one part in 10^9, plus
// 2^-32 turns. The position is accurate to half a millimetre. The chord is given the length of the
// arc, so it is slightly too long. At 0.5 rad/s and 100 ms, for example, the error is one part in
// ten thousand.
[[nodiscard]] Pose moved(const Pose& pose, const Motion& motion, std::uint64_t elapsed_us);

// Interpolates linearly between two poses that are span_us apart. Returns the pose at elapsed_us
// after `from`. The heading turns through the smaller of the two possible angles. If both angles
// are equal, the heading turns clockwise. Requires `0 <= elapsed_us <= span_us` and
// `0 < span_us <= 10^6`. The magnitudes of x and y must be at most 10^9 mm. Coordinates are rounded
// to the nearest integer, and ties are rounded up.
[[nodiscard]] Pose between(const Pose& from, const Pose& to, std::uint64_t elapsed_us,
                           std::uint64_t span_us);

// The difference between two poses in x, y and heading. The difference in heading is the smaller of
// the two possible angles.
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

// Returns true if the distance in `sum` exceeds kMaxResidualMm, or if the heading in `sum` exceeds
// kMaxResidualAngle. A sum may consist of up to 2^20 residuals.
[[nodiscard]] bool is_jump(const Residual& sum);

}  // namespace iog::pose
