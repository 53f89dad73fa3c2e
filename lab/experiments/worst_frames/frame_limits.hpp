// What a frame may have at most, by the constants of the code: how many points a scan may have, how
// many cells a line may cross, how many tiles there are.
#pragma once

#include "vehicle/vehicle.hpp"

namespace iog::lab {

struct FrameLimits {
  double points = 0;          // of all scans
  double range_m = 0;         // of the sensor that sees furthest
  double cells_per_beam = 0;  // of that sensor
  double cells = 0;
  double tiles = 0;
};

[[nodiscard]] FrameLimits frame_limits(const vehicle::Vehicle& vehicle);

}  // namespace iog::lab
