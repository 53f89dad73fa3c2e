// The sections in the order of the page. Each is a pure function of its input, so that they can run
// side by side, and prints the same for the same input on every machine; what was timed on the PC
// at hand says "on this PC" in its line.
#pragma once

#include "lab/experiments/section.hpp"

namespace iog::lab {

[[nodiscard]] Section output_rates(const TablesInput& input);  // tables 4.4 and 4.5
[[nodiscard]] Section goals(const TablesInput& input);         // and the floor below them
[[nodiscard]] Section worst_frames(const TablesInput& input);  // and the bound above them
[[nodiscard]] Section scaling(const TablesInput& input);       // where real time ends

}  // namespace iog::lab
