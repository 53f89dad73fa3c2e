// Checks whether the motion that a log states agrees with its positions.
#pragma once

#include <string>
#include <vector>

#include "tools/poses/pose_log.hpp"

namespace iog::tools {

// Names the headings, speeds and yaw rates that do not fit the positions, and by how much. Empty if
// all of them fit, or if the car drives less than 20 m. Also names a car that drives backwards on
// more than 90 % of its way, as it does if its headings are those of a unit that looks back. A log
// in radians, with compass headings, in km/h or in a camera's frame is plausible in each row, and
// only its own positions contradict it. `samples` contains one pose of the car for each of `poses`.
[[nodiscard]] std::string words_of_misfit(const std::vector<LoggedPose>& poses,
                                          const std::vector<PoseSample>& samples);

}  // namespace iog::tools
