#include "lab/experiments/index_differences.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "grid/frame_fusion.hpp"
#include "lab/evidence/fusion_rules.hpp"
#include "lab/reference/fusion.hpp"

namespace iog::lab {
namespace {

constexpr std::int32_t kNoSaturation = 1 << 30;
constexpr int kLastFreeStep = -3;  // of a cell as long as sigma: table 4.3

// A cell of which something is known.
struct Known {
  std::uint32_t cell;
  std::uint32_t measurements = 0;
  bool is_near = false;  // one of them is no free one
};

std::vector<Known> known_cells(const FrameEvidence& evidence) {
  std::vector<Known> of_cell(geometry::kCellCount);
  for (const CellEvidence& seen : evidence.cells) {
    Known& known = of_cell[seen.cell];
    known.cell = seen.cell;
    ++known.measurements;
    known.is_near = known.is_near || seen.step > kLastFreeStep;
  }
  std::erase_if(of_cell, [](const Known& known) { return known.measurements == 0; });
  return of_cell;
}

void add(double difference, const Known& known, double epsilon, Differences& differences) {
  differences.sum += difference;
  differences.squares += difference * difference;
  differences.sum_near += known.is_near ? difference : 0;
  differences.above_bound += difference > known.measurements * epsilon ? 1U : 0U;
  if (difference > differences.largest) {
    differences.largest = difference;
    differences.largest_of = known.measurements;
  }
}

}  // namespace

double Differences::standard_deviation() const {
  return std::sqrt(squares / static_cast<double>(cells) - mean() * mean());
}

double Differences::root_mean_square_of_known() const {
  return std::sqrt(squares / static_cast<double>(known));
}

// The log-odds of p_1 = 1/2 + epsilon, without the cancellation in their quotient.
QuantisedModel::QuantisedModel(const ByStep<double>& model, double of_epsilon,
                               index::Quantisation of_policy)
    : epsilon(of_epsilon),
      policy(of_policy),
      values(indexes(model, of_epsilon, of_policy)),
      log_odds_step(2 * std::atanh(2 * of_epsilon)) {}

double QuantisedModel::error_at(const ByStep<double>& model, int step) const {
  const std::size_t slot = slot_of(step);
  return std::abs(reference::probability_of_log_odds(values[slot] * log_odds_step) - model[slot]);
}

void compare(const FrameEvidence& evidence, const ByStep<double>& model,
             std::vector<QuantisedModel>& quantised) {
  const std::vector<Known> known_of_frame = known_cells(evidence);
  const auto exact = fuse_probabilities(evidence, model, ProbabilityRule::kBayes);
  for (QuantisedModel& one : quantised) {
    const auto sums = fuse_indexes(evidence, one.values, IndexRule::kSequential, kNoSaturation);
    one.differences.cells += geometry::kCellCount;
    one.differences.known += known_of_frame.size();
    for (const Known& known : known_of_frame) {
      const std::int32_t n = sums[known.cell];
      const double p = reference::probability_of_log_odds(n * one.log_odds_step);
      one.differences.largest_index =
          std::max(one.differences.largest_index, std::abs(std::int64_t{n}));
      add(std::abs(p - exact[known.cell]), known, one.epsilon, one.differences);
    }
  }
}

}  // namespace iog::lab
