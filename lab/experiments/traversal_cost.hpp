// What a visited cell costs the Cortex-A9 (table 4.2, execution time): a part of the section on
// traversal.
#pragma once

#include "lab/experiments/section.hpp"

namespace iog::lab {

void add_traversal_cost(Section& section);

}  // namespace iog::lab
