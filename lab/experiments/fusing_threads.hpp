// The fusing of frames divided by packets, as the firmware does it, by threads of this PC.
#pragma once

#include <string_view>

namespace iog::lab {

// The time that one thread takes for frames of the reference car's drive, by that of two: both in
// turns, the median of some rounds. Of a PC with one processor it is 1 at most.
[[nodiscard]] double time_ratio_of_two_threads(std::string_view scene);

}  // namespace iog::lab
