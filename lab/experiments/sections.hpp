// The sections in the order of the page. Each is a pure function of its input, so that they can run
// side by side, and prints the same for the same input on every machine; what was timed on the PC
// at hand says "on this PC" in its line.
#pragma once

#include "lab/experiments/section.hpp"

namespace iog::lab {

[[nodiscard]] Section recursive_sets(const TablesInput& input);        // figure 3.6
[[nodiscard]] Section inverse_sensor_model(const TablesInput& input);  // table 4.1
[[nodiscard]] Section profiles(const TablesInput& input);              // table 4.3, fig. 4.6, 4.14
[[nodiscard]] Section traversal_accuracy(const TablesInput& input);    // table 4.2, figure 4.11
[[nodiscard]] Section output_rates(const TablesInput& input);          // tables 4.4 and 4.5
[[nodiscard]] Section goals(const TablesInput& input);                 // and the floor below them
[[nodiscard]] Section worst_frames(const TablesInput& input);          // and the bound above them
[[nodiscard]] Section scaling(const TablesInput& input);               // where real time ends
[[nodiscard]] Section numerical_quality(const TablesInput& input);     // table 4.6
[[nodiscard]] Section quadtree(const TablesInput& input);              // table 4.7
[[nodiscard]] Section stream_of_tiles(const TablesInput& input);       // bytes, cycles, bad links
[[nodiscard]] Section many_core(const TablesInput& input);             // many-core paper, table I
[[nodiscard]] Section order_of_fusion(const TablesInput& input);       // sequential against ours
[[nodiscard]] Section detection_quality(const TablesInput& input);     // what the choices cost
[[nodiscard]] Section price_of_hits_win(const TablesInput& input);     // rain, ghosts, thin gaps

}  // namespace iog::lab
