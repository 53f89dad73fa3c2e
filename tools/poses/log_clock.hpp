// Whether the clock of a log was set while it was written, as by NTP or a leap second.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/poses/pose_log.hpp"

namespace iog::tools {

// Returns "the log's clock steps by -0.500 s at line 201, ..." for the first step: the time between
// two successive poses differs from the log's period, although the distance of the moving car does
// not. `poses` is in the order of the log, and `unit` is the word for LoggedPose::place. Returns an
// empty text if there is none. Steps are found from 0.1 s and half a period on, up to 2 s forward,
// if the car drives 2 m/s or more and five poses on each side keep the period.
[[nodiscard]] std::string words_of_clock_step(const std::vector<LoggedPose>& poses,
                                              std::string_view unit);

}  // namespace iog::tools
