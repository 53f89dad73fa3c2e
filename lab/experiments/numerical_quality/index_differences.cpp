#include "lab/experiments/numerical_quality/index_differences.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "fusion/frame_fusion.hpp"
#include "lab/evidence/fusion_rules.hpp"
#include "lab/reference/fusion.hpp"

namespace iog::lab {
namespace {

constexpr std::int32_t kNoSaturation = 1 << 30;
// Of a cell as long as sigma: table 4.3. Of one that is farther behind the scan point than k + 2 a
// beam says 1/2, to 0.0003.
constexpr int kLastFreeStep = -3;
constexpr int kLastKnownStep = 2;

// A cell that a beam has come to.
struct Visited {
  std::uint32_t cell;
  std::uint32_t measurements = 0;
  bool is_near = false;   // one of them is no free one
  bool is_known = false;  // one of them is not 1/2
};

std::vector<Visited> visited_cells(const FrameEvidence& evidence) {
  std::vector<Visited> of_cell(geometry::kCellCount);
  for (const CellEvidence& seen : evidence.cells) {
    Visited& visited = of_cell[seen.cell];
    visited.cell = seen.cell;
    ++visited.measurements;
    visited.is_near = visited.is_near || seen.step > kLastFreeStep;
    visited.is_known = visited.is_known || seen.step <= kLastKnownStep;
  }
  std::erase_if(of_cell, [](const Visited& visited) { return visited.measurements == 0; });
  return of_cell;
}

void add(double difference, const Visited& visited, double epsilon, Differences& differences) {
  differences.sum += difference;
  differences.squares += difference * difference;
  if (visited.is_known) {
    ++differences.known;
    differences.sum_known += difference;
    differences.squares_known += difference * difference;
  }
  differences.sum_near += visited.is_near ? difference : 0;
  differences.above_bound += difference > visited.measurements * epsilon ? 1U : 0U;
  if (difference > differences.largest) {
    differences.largest = difference;
    differences.largest_of = visited.measurements;
  }
}

}  // namespace

double Differences::standard_deviation() const {
  return std::sqrt(squares / static_cast<double>(cells) - mean() * mean());
}

double Differences::root_mean_square_of_known() const {
  return std::sqrt(squares_known / static_cast<double>(known));
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
  const std::vector<Visited> visited_of_frame = visited_cells(evidence);
  const auto exact = fuse_probabilities(evidence, model);
  for (QuantisedModel& one : quantised) {
    const auto sums = fuse_indexes(evidence, one.values, IndexRule::kSequential, kNoSaturation);
    one.differences.cells += geometry::kCellCount;
    for (const Visited& visited : visited_of_frame) {
      const std::int32_t n = sums[visited.cell];
      const double p = reference::probability_of_log_odds(n * one.log_odds_step);
      one.differences.largest_index =
          std::max(one.differences.largest_index, std::abs(std::int64_t{n}));
      add(std::abs(p - exact[visited.cell]), visited, one.epsilon, one.differences);
    }
  }
}

}  // namespace iog::lab
