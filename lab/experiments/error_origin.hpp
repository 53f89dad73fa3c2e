// Where the differences of table 4.6 come from, and what bounds them: a subsection.
#pragma once

#include <vector>

#include "lab/experiments/index_differences.hpp"
#include "lab/experiments/section.hpp"

namespace iog::lab {

// rows: the recursive sets and policies with what was found of each, at least one; model: what was
// quantised.
void add_error_origin(const std::vector<QuantisedModel>& rows, const ByStep<double>& model,
                      Section& section);

}  // namespace iog::lab
