// What a satellite receiver says of its places, and the poses that follow from it.
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
// A fix without a heading takes it from its course at 1 m/s and more. A course is the heading of a
// car that drives forwards, and half a turn off it in reverse: of the two, that is taken which a
// car can have turned to since the fix before, given a circle of 5 m and 8 m/s^2 to the side. A car
// that stops keeps its heading, as uncertain as the way below 1 m/s makes it. The course alone does
// not say whether a stretch of such fixes begins forwards or in reverse. Forwards is the direction
// that
//   - fits stated headings before or behind, or
//   - is driven at 8 m/s or more, or
//   - is driven at 3 m/s or more and half as fast again as the other one, or else
//   - comes first in a stretch that begins in motion.
// The last two are noted as assumptions. Stretches from standstill that none of this decides are
// left without headings, which is remarked.
[[nodiscard]] PoseLog log_of(std::vector<Fix> fixes, std::string_view unit);

}  // namespace iog::tools
