// Whether the motion that a log states is that of its positions.
#pragma once

#include <string>
#include <vector>

#include "tools/poses/pose_log.hpp"

namespace iog::tools {

// The headings, speeds and yaw rates that do not fit the positions, and by how much; empty: all
// fit, or the car drives less than 20 m. A log in radians, by the compass, in km/h or of a camera's
// frame is sound in each row, and only its own positions contradict it. samples: the poses as those
// of the car, one for each.
[[nodiscard]] std::string words_of_misfit(const std::vector<LoggedPose>& poses,
                                          const std::vector<PoseSample>& samples);

}  // namespace iog::tools
