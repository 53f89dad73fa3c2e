// What was measured on the emulated Cortex-A9 (bench/cortex_a9.txt), compiled into the program.
#pragma once

#include <string_view>

namespace iog::tools {

// The number of that key in the line of that run, e.g. ("frame_cost sensors=4", "frame_mean").
// std::out_of_range if there is none.
[[nodiscard]] double measured_on_a9(std::string_view run, std::string_view key);

}  // namespace iog::tools
