// Table 4.5 of the thesis: what its rate is worth, in scan points times cells a second.
#pragma once

#include "lab/experiments/a9_cycles.hpp"
#include "lab/experiments/a9_frame.hpp"
#include "lab/experiments/section.hpp"

namespace iog::lab {

// Adds claims, a subheading, the formula and the table, for a frame of four LUX at the load at
// which the thesis is compared with.
void add_points_cells_hz(const A9Frame& frame, const A9Cycles& cycles, Section& section);

}  // namespace iog::lab
