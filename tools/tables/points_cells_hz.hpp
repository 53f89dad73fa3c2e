// Table 4.5 of the thesis: what its rate is worth, in scan points times cells a second.
#pragma once

#include "tools/tables/a9_cycles.hpp"
#include "tools/tables/a9_frame.hpp"
#include "tools/tables/section.hpp"

namespace iog::tools {

// Adds claims, a subheading, the formula and the table, for a frame of four LUX at the load at
// which the thesis is compared with.
void add_points_cells_hz(const A9Frame& frame, const A9Cycles& cycles, Section& section);

}  // namespace iog::tools
