// Which laser of a unit saw a point, and what it counted.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "tools/car/description.hpp"

namespace iog::tools {

struct LaserPoint {
  std::size_t layer = 0;
  double range_m = 0;  // as the unit counts it, before its maker's correction
  double right = 0;    // of forward, in turns: how far the head has turned, without channel offsets
  double off_m = 0;    // how far from what the laser sees
  bool is_sure = false;  // by so little that the next ring is not meant
};

class LaserTable {
 public:
  // Its lasers are those of its calibration, or else those of its format, a Velodyne's.
  explicit LaserTable(const description::SensorConfig& config);

  // A point in the frame of the unit, in metres. On a cone z = v + r tan(elevation) lies what a
  // laser sees: its laser is that of the nearest cone. Empty if that is further off than 1 cm and a
  // quarter of a degree: no laser looks there.
  [[nodiscard]] std::optional<LaserPoint> laser_of(double x, double y, double z) const;

 private:
  struct Cone {
    double rise = 0;      // tangent of its elevation
    double height_m = 0;  // v, where its beam, drawn backwards, meets the unit's axis
    double cosine = 1;    // of its elevation
    double more_m = 0;    // how much more it counts than the way from there
    double left = 0;      // of where the head looks, in turns
  };
  std::vector<Cone> cones_;  // by layer
};

}  // namespace iog::tools
