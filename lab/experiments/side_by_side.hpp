// Experiments on all cores of the PC.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "lab/experiments/experiment.hpp"

namespace iog::lab {

// Runs them as many at a time as the PC has cores; the answer is in their order. on_done is told
// how many are ready, from one thread at a time. If an experiment throws, no other is begun;
// UsageError stays one, everything else becomes a std::runtime_error with the experiment's name.
[[nodiscard]] std::vector<Tables> run_side_by_side(std::span<const Experiment> experiments,
                                                   const Input& input,
                                                   const std::function<void(std::size_t)>& on_done);

}  // namespace iog::lab
