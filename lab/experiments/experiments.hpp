// The experiments, in the order of the page that shows them.
#pragma once

#include "lab/experiments/experiment.hpp"

namespace iog::lab {

[[nodiscard]] Tables recursive_sets(const Input& input);  // thesis, figure 3.6, section 3.4.6.3

}  // namespace iog::lab
