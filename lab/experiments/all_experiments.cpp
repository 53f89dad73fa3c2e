#include <array>

#include "lab/experiments/experiments.hpp"

namespace iog::lab {
namespace {

constexpr auto kExperiments = std::to_array<Experiment>({
    {"recursive_sets", recursive_sets},
});

}  // namespace

std::span<const Experiment> all_experiments() { return kExperiments; }

}  // namespace iog::lab
