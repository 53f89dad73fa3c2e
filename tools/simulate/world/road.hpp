// The centre line of a simulated road, measured by its station, the way along it in metres: a
// gentle curve without end, or a line of a map.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "tools/simulate/world/solid.hpp"

namespace iog::tools {

// How far anything is seen, and how far beyond both ends of the drive the world reaches: a little
// more than a LUX does.
inline constexpr double kSight = 210.0;

// How the road's heading changes with its station: a steady turn and two swings about it.
struct Course {
  struct Swing {
    double radians;
    double wavelength;  // metres
  };
  double radians_per_metre = 0;  // of the steady turn, to the left
  std::array<Swing, 2> swings{};

  [[nodiscard]] double heading_at(double station) const;  // radians
};

// first_m, first_m + step_m, ... as long as they are below end_m.
[[nodiscard]] std::vector<double> stations(double first_m, double end_m, double step_m);

class Road {
 public:
  struct Point {
    double x;
    double y;
  };
  static constexpr double kStep = 0.5;  // metres from one point to the next

  // A road that is known from first_m to last_m.
  Road(const Course& course, double first_m, double last_m);

  // A road through at least four points, kStep apart; at one of them its station is 0.
  Road(std::vector<Point> points, std::size_t zero);

  // `left` metres to the left of the centre line, pointing along the road. station: within the
  // road's length.
  [[nodiscard]] Placement at(double station, double left) const;

  // Where along the road and how far to its left a point is that is nearer to the road than the
  // radius of its curves.
  struct Place {
    double station;
    double left;
  };
  [[nodiscard]] Place nearest(double x, double y) const;
  // The same, sought from a station that is not far.
  [[nodiscard]] Place nearest(double x, double y, double station) const;

 private:
  // The unit vector along the road, as a placement's heading.
  [[nodiscard]] Placement heading_at(double station, std::size_t before, double share) const;

  std::optional<Course> course_;  // none: the heading is that of the points
  double first_;
  std::vector<Point> points_;
};

// `by`: cosine and sine of a further turn to the left.
[[nodiscard]] Placement turned_by(const Placement& placement, double cos, double sin);

// The placement moved by that much along its own heading and to its own left.
[[nodiscard]] Placement moved(const Placement& placement, double forward, double left);

}  // namespace iog::tools
