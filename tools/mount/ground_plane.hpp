// The ground around a lidar that turns, as a plane through the returns of one scan.
#pragma once

#include <optional>
#include <span>

namespace iog::tools {

// Metres from the unit's origin, along the axes that the car would have if it stood as its file
// says.
struct RoadReturn {
  double x_m = 0;
  double y_m = 0;
  double z_m = 0;
};

// How far out the plane is looked for: what is nearer shows little of a slope, what is farther is
// another slope.
inline constexpr double kNearestRoadM = 4;
inline constexpr double kFarthestRoadM = 18;

// The file may be wrong by so much.
inline constexpr int kMostTiltDeg = 10;
inline constexpr double kMostHeightErrorM = 1;

// z = along x + across y - below.
struct GroundPlane {
  double along = 0;
  double across = 0;
  double below_m = 0;
  double bend_per_m = 0;
  double residual_m = 0;  // standard deviation of what lies on it
};

// The returns are those of one scan, of the range above. expected_m: the unit's height by the car's
// file. None: they show no ground that is a plane, and what they show instead decides nothing.
[[nodiscard]] std::optional<GroundPlane> ground_plane_of(std::span<const RoadReturn> returns,
                                                         double expected_m);

}  // namespace iog::tools
