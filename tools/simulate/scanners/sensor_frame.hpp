// The axes and the place of a scanner, in the vehicle or in the world.
#pragma once

#include "tools/car/description.hpp"
#include "tools/simulate/world/solid.hpp"
#include "tools/simulate/world/traffic.hpp"

namespace iog::tools {

struct SensorFrame {
  Vector3 origin;
  Vector3 forward;
  Vector3 left;
  Vector3 up;

  // A direction that is given along these axes.
  [[nodiscard]] Vector3 direction(const Vector3& v) const;
};

// In the vehicle.
[[nodiscard]] SensorFrame frame_of(const description::MountConfig& mount);

// In the world, of a scanner that is so mounted on the car.
[[nodiscard]] SensorFrame placed(const SensorFrame& mount, const EgoPose& ego);

}  // namespace iog::tools
