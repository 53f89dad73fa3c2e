// What was measured on the emulated Cortex-A9 (lab/target/cortex_a9.txt), compiled into the
// program.
//
// A run is named by the first words of its line, e.g. "frame_cost sensors=4" or "traversal_cost
// walk=discrete r=100"; key=value pairs follow.
#pragma once

#include <string_view>

namespace iog::lab {

// Whether a run begins with these words.
[[nodiscard]] bool has_a9_run(std::string_view run);

// The number of that key in the line of that run, e.g. ("frame_cost sensors=4", "frame_mean").
// std::out_of_range if there is none.
[[nodiscard]] double measured_on_a9(std::string_view run, std::string_view key);

// The same for what is not a number, as it stands there: a run hash, a vehicle's name.
[[nodiscard]] std::string_view word_from_a9(std::string_view run, std::string_view key);

// What stands in the file's head under that name, e.g. "compiler" or "emulator".
[[nodiscard]] std::string_view a9_made_with(std::string_view name);

}  // namespace iog::lab
