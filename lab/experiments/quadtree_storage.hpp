// What a quadtree keeps of the grid, which is everything, and in how many bytes (thesis section
// 4.3.2.2).
#pragma once

#include "lab/experiments/section.hpp"

namespace iog::lab {

// Builds the linear quadtree and the reference of every frame of both simulated drives, and of
// grids that no drive makes; compares them with the array and counts their bytes. std::logic_error
// that names the grid if anything differs.
void add_storage(const TablesInput& input, Section& section);

}  // namespace iog::lab
