// What a 1D cell of the local grid is worth: probabilities by Theorem 6, and indexes by
// quantisation.
#pragma once

#include <array>
#include <cstdint>

#include "index/recursive_set.hpp"
#include "lab/evidence/projection.hpp"

namespace iog::lab {

// By slot_of(step).
template <typename Value>
using ByStep = std::array<Value, kStepCount>;

struct ModelConfig {
  double sigma_m = 0.10;
  double cell_length_m = 0.10;
  double floor = 0.05;  // an ISM below is raised to it (thesis section 4.3.1.1)
};

// The inverse sensor model in double precision, computed by the reference (lab/reference), not by
// the code that the firmware's tables come from.
[[nodiscard]] ByStep<double> probabilities(const ModelConfig& config);

// Its occupancy indexes. epsilon may be as small as 1e-6: the free index is then some -700,000.
[[nodiscard]] ByStep<std::int32_t> indexes(const ByStep<double>& probabilities, double epsilon,
                                           index::Quantisation policy);

}  // namespace iog::lab
