// Whether the clock of a log was set while it was written, as by NTP or a leap second.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/poses/pose_log.hpp"

namespace iog::tools {

// "the log's clock steps by -0.500 s at line 201: ...": between two poses that follow each other in
// the log, time passes by another span than between their neighbours, and the way of the moving car
// does not. In the order of the log. Empty if there is none.
[[nodiscard]] std::string words_of_clock_step(const std::vector<LoggedPose>& poses,
                                              std::string_view unit);

}  // namespace iog::tools
