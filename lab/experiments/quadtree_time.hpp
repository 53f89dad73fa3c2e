// What a quadtree costs a frame: built once, or kept up to date at every cell (thesis section
// 4.3.2.2).
#pragma once

#include "lab/experiments/section.hpp"

namespace iog::lab {

void add_tree_time(const TablesInput& input, Section& section);

}  // namespace iog::lab
