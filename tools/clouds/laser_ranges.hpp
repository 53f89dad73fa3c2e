// A scan of a 2D scanner, whose beams are evenly apart in its plane, as a cloud.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tools/clouds/cloud_fields.hpp"

namespace iog::tools {

// Angles are counter-clockwise from the scanner's x axis.
struct LaserRanges {
  std::uint64_t stamp_us = 0;  // of the first beam, since 1970
  double first_rad = 0;        // direction of the first beam
  double last_rad = 0;         // of the last beam, or one step beyond it
  double step_rad = 0;         // from beam to beam: up to 0.2 or down to -0.2, and not 0
  double apart_s = 0;          // from beam to beam; 0: all at once
  double least_m = 0;          // the shortest range that is measured
  double most_m = static_cast<double>(std::numeric_limits<float>::max());  // finite, above 0
  std::vector<double> ranges_m{};  // of each beam in turn, at most kMostCloudPoints
};

// Returns a point in the scanner's plane for each beam. A beam has no return, and its point has the
// flag PointsPacket::kNothing, if its range is infinite, above most_m (REP 117), or most_m to the
// nearest millimetre, which some drivers and simulators give instead. A beam is left out and
// counted if its range is NaN, below least_m, or 0. Times of beams are left out if they are
// negative, no number, or of more than a second.
// Throws a UsageError that begins with `what` if there are too many ranges, for the reasons of
// demand_metres(), or if the scan's header is contradictory or describes no scan.
[[nodiscard]] SeenCloud cloud_of_ranges(const LaserRanges& scan, const std::string& what);

}  // namespace iog::tools
