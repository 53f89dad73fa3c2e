// What is true of the cells of a perceived drive, frame by frame.
#pragma once

#include <vector>

#include "geometry/cell.hpp"
#include "geometry/grid.hpp"
#include "lab/evaluation/true_things.hpp"
#include "lab/experiments/perception/perceived_drive.hpp"
#include "pose/pose.hpp"

namespace iog::lab {

inline constexpr double kWindowCellM = geometry::kCellMm / 1000.0;

// Where points of the local frame are in the world, by the pose that a slice was placed with and
// the one that the car truly had.
class LocalToWorld {
 public:
  LocalToWorld() = default;
  LocalToWorld(const pose::Pose& placed, const tools::Placement& truth);

  struct Point {
    double x_m = 0;
    double y_m = 0;
  };
  // Metres of the local frame.
  [[nodiscard]] Point at(double x_m, double y_m) const;
  [[nodiscard]] Point centre_of(geometry::Cell cell) const {
    return at((cell.x + 0.5) * kWindowCellM, (cell.y + 0.5) * kWindowCellM);
  }
  // A way, or a velocity.
  [[nodiscard]] Point turned(double x, double y) const {
    return {cos_ * x - sin_ * y, sin_ * x + cos_ * y};
  }
  // Where the car truly was.
  [[nodiscard]] const Point& car() const { return truth_; }

 private:
  Point placed_;
  Point truth_;
  double cos_ = 1;  // of the turn from the local frame to the world
  double sin_ = 0;
};

// The truth of one frame: a time, a place and the things for each slice that was placed. A frame
// without a slice has one, of its end, with the place of the frame before.
class FrameTruth {
 public:
  struct Slice {
    LocalToWorld to_world;
    TrueThings things;
  };
  FrameTruth(const PerceivedFrame& frame, const LocalToWorld& before);

  [[nodiscard]] const Slice& last() const { return slices_.back(); }
  [[nodiscard]] TrueThing near(const HitCell& hit) const;
  // Whether at the time of any slice something moved within 0.2 m of the cell's centre.
  [[nodiscard]] bool is_near_mover(geometry::Cell cell) const;

 private:
  std::vector<Slice> slices_;
};

}  // namespace iog::lab
