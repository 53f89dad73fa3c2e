// Where the scan points of a sensor lie in its car, as description and calibration say: in metres
// and floating point, for what only the PC asks.
#pragma once

#include <vector>

#include "lidar/scan_point.hpp"
#include "tools/car/description.hpp"
#include "tools/car/mount.hpp"

namespace iog::tools {

struct PointPlace {
  double x_m = 0;  // in the vehicle frame
  double y_m = 0;
  double z_m = 0;
};

class PointPlacer {
 public:
  explicit PointPlacer(const description::SensorConfig& sensor);

  // Of a point of the sensor's own packets that has a range.
  [[nodiscard]] PointPlace place(const lidar::ScanPoint& point) const;

 private:
  struct Layer {
    double elevation_rad = 0;
    double height_m = 0;    // of the beam's start over the unit's origin, up the unit's axis
    bool looks_up = false;  // of a tilted mirror
  };

  [[nodiscard]] double elevation_rad(const Layer& layer, double azimuth_rad) const;

  description::MountConfig mount_;
  description::Rotation turn_;
  double radians_per_tick_ = 0;
  double tilt_rad_ = 0;  // of the mirror; 0: it has none
  std::vector<Layer> layers_;
};

}  // namespace iog::tools
