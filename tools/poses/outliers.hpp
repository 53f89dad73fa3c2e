// Finds the poses of a log that one car can have had, so that an outlier does not spoil its
// neighbours.
#pragma once

#include <vector>

#include "tools/poses/pose_log.hpp"

namespace iog::tools {

// Among poses with headings, the longest chain in which time rises by at least 8 ms and each pose
// follows from its neighbours: at most 100 m/s and 10 rad/s, and off the motion so far by no more
// than 10 m/s^2 and 3 rad/s^2 explain, plus 0.3 m and 0.15 rad, or 8 times the log's median if it
// is noisier. After 1.5 s of silence a car may be anywhere. Of two chains of equal length, the
// earlier.
[[nodiscard]] std::vector<bool> drivable(const std::vector<LoggedPose>& poses);

}  // namespace iog::tools
