// Which poses of a log one car can have had, so that an outlier does not spoil those around it.
#pragma once

#include <vector>

#include "tools/poses/pose_log.hpp"

namespace iog::tools {

// Of poses with headings: those of the longest chain in which time rises by 8 ms at least and each
// pose follows from those beside it: at most 100 m/s and 10 rad/s, and off the motion so far by no
// more than 10 m/s^2 and 3 rad/s^2 explain, and 0.3 m and 0.15 rad beside that, or 8 times the
// log's median where a log is noisier. After 1.5 s of silence a car may be anywhere. Of two chains
// of one length, the earlier.
[[nodiscard]] std::vector<bool> drivable(const std::vector<LoggedPose>& poses);

}  // namespace iog::tools
