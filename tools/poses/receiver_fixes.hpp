// A satellite receiver's fixes, and the poses that follow from them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "tools/poses/local_plane.hpp"
#include "tools/poses/pose_log.hpp"

namespace iog::tools {

// Angles are degrees clockwise from north. What is not known is empty.
struct Fix {
  std::uint64_t time_us = 0;
  Geodetic at{};
  std::optional<double> speed_mps{};    // over ground, never negative
  std::optional<double> course_deg{};   // the direction of motion
  std::optional<double> heading_deg{};  // of the vehicle: stated, or filled in by the course
  std::optional<double> sigma_m{};
  std::optional<double> sigma_heading_rad{};
  double heading_doubt_rad = 0;
  std::size_t place = 0;
};

// Poses in the plane of the first position that is within some 100 km of most others.
//
// From 1 m/s on, a fix without a heading takes it from its course. The course equals the heading of
// a car that drives forwards and is half a turn off in reverse: the one is taken that the car can
// have turned to since the fix before, given a turning circle of 5 m and 8 m/s^2 sideways. A car
// that stops keeps its heading, less certain with the distance below 1 m/s. The course alone does
// not say whether a stretch of such fixes begins forwards or in reverse. Forwards is the direction
// that
//   - fits stated headings before or behind, or
//   - is driven at 8 m/s or more, or
//   - is driven at 3 m/s or more and 1.5 times as fast as the other one, or else
//   - comes first in a stretch that begins in motion.
// The last two are noted as assumptions. Undecided stretches from standstill are left without
// headings, and remarked.
[[nodiscard]] PoseLog log_of(std::vector<Fix> fixes, std::string_view unit);

}  // namespace iog::tools
