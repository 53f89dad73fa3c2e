// Table 4.7 of the thesis: for how many cells a leaf and a node of a quadtree stand.
#pragma once

#include "lab/experiments/section.hpp"

namespace iog::lab {

// Adds the table for both simulated drives, and what the thesis claims of it.
void add_compactness(const TablesInput& input, Section& section);

}  // namespace iog::lab
