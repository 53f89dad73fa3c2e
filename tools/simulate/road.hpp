// The centre line of a simulated road: a gentle curve without end, measured by its station, the way
// along it in metres.
#pragma once

#include <array>
#include <vector>

#include "tools/simulate/solid.hpp"

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
  // A road that is known from first_m to last_m.
  Road(const Course& course, double first_m, double last_m);

  // `left` metres to the left of the centre line, pointing along the road. station: within the
  // road's length.
  [[nodiscard]] Placement at(double station, double left) const;

 private:
  struct Point {
    double x;
    double y;
  };

  Course course_;
  double first_;
  std::vector<Point> points_;  // every half metre
};

// `by`: cosine and sine of a further turn to the left.
[[nodiscard]] Placement turned_by(const Placement& placement, double cos, double sin);

// The placement moved by that much along its own heading and to its own left.
[[nodiscard]] Placement moved(const Placement& placement, double forward, double left);

}  // namespace iog::tools
