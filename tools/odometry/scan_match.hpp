// Where a scan lies in the local map: iterated closest planes, by Gauss and Newton.
#pragma once

#include <Eigen/Geometry>
#include <span>

#include "tools/odometry/local_map.hpp"

namespace iog::tools {

using Pose = Eigen::Isometry3d;

struct ScanMatch {
  Pose pose;  // of the car in the map
  // Of the motion along the least certain direction of the ground, as a share of all planes: how
  // much they face it. 0 in an endless tunnel and on an empty plain.
  double least_support = 0;
  double agreement = 0;   // of all points with the map's planes: 1, all lie on one
  double residual_m = 0;  // root mean square of those
};

// How far off a prediction may be.
struct Doubt {
  double most_m;   // of any point
  double sigma_m;  // of the car, which holds directions that no plane faces
  double sigma_rad;
};

// points: in the car's frame. Without any plane, the pose is the prediction.
[[nodiscard]] ScanMatch match_scan(std::span<const Eigen::Vector3d> points, const LocalMap& map,
                                   const Pose& predicted, const Doubt& doubt);

}  // namespace iog::tools
