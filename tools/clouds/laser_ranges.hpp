// A scan of a 2D scanner, whose beams are evenly apart in its plane, as a cloud.
#pragma once

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "tools/clouds/cloud_fields.hpp"

namespace iog::tools {

struct LaserRanges {
  std::uint64_t stamp_us = 0;
  double first_rad = 0;
  double last_rad = 0;
  double step_rad = 0;
  double apart_s = 0;  // from beam to beam; 0: not known
  double least_m = 0;
  double most_m = static_cast<double>(std::numeric_limits<float>::max());
  std::vector<double> ranges_m{};
};

// An infinite range, or a range above the maximum, means that the beam had no return (REP 117).
// Throws a UsageError that begins with `what` if there are too many ranges, for the reasons of
// demand_metres(), or if the scan's header is contradictory or describes no scan.
[[nodiscard]] SeenCloud cloud_of_ranges(const LaserRanges& scan, const std::string& what);

}  // namespace iog::tools
