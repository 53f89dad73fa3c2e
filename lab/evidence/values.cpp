#include "lab/evidence/values.hpp"

#include <algorithm>

#include "lab/reference/inverse_sensor_model.hpp"

namespace iog::lab {

// The scan point sits in the middle of a local grid so long that neither of its ends is seen from
// there: a term of Theorem 6 thirty cells and twelve sigma off is below 1e-30 of the largest.
ByStep<double> probabilities(const ModelConfig& config) {
  const int margin =
      2 * kFarSteps + 30 + static_cast<int>(12 * config.sigma_m / config.cell_length_m);
  const int k = margin;
  const reference::LocalGrid grid{.cells = 2 * margin, .cell_length_m = config.cell_length_m};
  const reference::RangeSensor sensor{.sigma_m = config.sigma_m};
  const reference::Likelihoods likelihoods =
      reference::likelihoods(sensor, grid, grid.distance_m(k));
  ByStep<double> values{};
  for (int step = -kFarSteps; step <= kFarSteps; ++step) {
    const double probability = reference::theorem_6(likelihoods, k + step).probability;
    values[slot_of(step)] = std::max(probability, config.floor);
  }
  return values;
}

ByStep<std::int32_t> indexes(const ByStep<double>& probabilities, double epsilon,
                             index::Quantisation policy) {
  const index::RecursiveSet set(epsilon);
  ByStep<std::int32_t> values{};
  std::ranges::transform(probabilities, values.begin(),
                         [&](double probability) { return set.quantise(probability, policy); });
  return values;
}

}  // namespace iog::lab
