#include "tools/simulate/scanners/sensor_frame.hpp"

#include "tools/car/mount.hpp"

namespace iog::tools {

Vector3 SensorFrame::direction(const Vector3& v) const {
  return {forward.x * v.x + left.x * v.y + up.x * v.z, forward.y * v.x + left.y * v.y + up.y * v.z,
          forward.z * v.x + left.z * v.y + up.z * v.z};
}

SensorFrame frame_of(const description::MountConfig& mount) {
  const auto turn = description::rotation_of(mount);
  return {.origin = {mount.x_m, mount.y_m, mount.z_m},
          .forward = {turn.forward[0], turn.forward[1], turn.forward[2]},
          .left = {turn.left[0], turn.left[1], turn.left[2]},
          .up = {turn.up[0], turn.up[1], turn.up[2]}};
}

SensorFrame placed(const SensorFrame& mount, const EgoPose& ego) {
  const Placement& at = ego.at;
  const Vector3 left{-at.sin, at.cos, 0};
  const Vector3 up{at.cos * ego.pitch_sin, at.sin * ego.pitch_sin, ego.pitch_cos};
  const auto rolled = [](const Vector3& a, double cos, const Vector3& b, double sin) {
    return Vector3{a.x * cos + b.x * sin, a.y * cos + b.y * sin, a.z * cos + b.z * sin};
  };
  const SensorFrame car{.origin = {at.x, at.y, ego.z},
                        .forward = {at.cos * ego.pitch_cos, at.sin * ego.pitch_cos, -ego.pitch_sin},
                        .left = rolled(left, ego.roll_cos, up, ego.roll_sin),
                        .up = rolled(up, ego.roll_cos, left, -ego.roll_sin)};
  const Vector3 offset = car.direction(mount.origin);
  return {.origin = {at.x + offset.x, at.y + offset.y, ego.z + offset.z},
          .forward = car.direction(mount.forward),
          .left = car.direction(mount.left),
          .up = car.direction(mount.up)};
}

}  // namespace iog::tools
