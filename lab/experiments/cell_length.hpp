// Figure 4.6 of the thesis: what the length of a 1D cell does to the inverse sensor model.
#pragma once

#include "lab/experiments/section.hpp"

namespace iog::lab {

// Adds claims, a subheading, a table and two plots.
void add_cell_lengths(const TablesInput& input, Section& section);

}  // namespace iog::lab
