// The axes of a sensor in its car.
#pragma once

#include <array>

#include "numeric/elementary.hpp"
#include "tools/car/description.hpp"

namespace iog::description {

constexpr double radians(double degrees) { return degrees * numeric::kPi / 180; }

// Rz(yaw) Ry(pitch) Rx(roll), column by column: the sensor's forward, left and up in the vehicle.
struct Rotation {
  std::array<double, 3> forward;
  std::array<double, 3> left;
  std::array<double, 3> up;
};

constexpr Rotation rotation_of(const MountConfig& mount) {
  const double cy = numeric::cos(radians(mount.yaw_deg));
  const double sy = numeric::sin(radians(mount.yaw_deg));
  const double cp = numeric::cos(radians(mount.pitch_deg));
  const double sp = numeric::sin(radians(mount.pitch_deg));
  const double cr = numeric::cos(radians(mount.roll_deg));
  const double sr = numeric::sin(radians(mount.roll_deg));
  return {.forward = {cy * cp, sy * cp, -sp},
          .left = {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr},
          .up = {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr}};
}

}  // namespace iog::description
