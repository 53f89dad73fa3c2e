#include "lab/evidence/fusion_rules.hpp"

#include <algorithm>
#include <cmath>

#include "fusion/frame_fusion.hpp"
#include "lab/reference/fusion.hpp"

namespace iog::lab {
namespace {

template <typename Value>
Value at(const ByStep<Value>& values, std::int8_t step) {
  return values[slot_of(step)];
}

std::vector<std::int32_t> fuse_in_order(const FrameEvidence& evidence,
                                        const ByStep<std::int32_t>& values, std::int32_t limit) {
  std::vector<std::int32_t> cells(geometry::kCellCount);
  for (const CellEvidence& seen : evidence.cells) {
    std::int32_t& cell = cells[seen.cell];
    cell = std::clamp(cell + at(values, seen.step), -limit, limit);
  }
  return cells;
}

// First all that is negative, then all that is positive.
std::vector<std::int32_t> fuse_by_sign(const FrameEvidence& evidence,
                                       const ByStep<std::int32_t>& values, bool hits_win,
                                       std::int32_t limit) {
  std::vector<std::int32_t> cells(geometry::kCellCount);
  for (const CellEvidence& seen : evidence.cells) {
    const std::int32_t value = at(values, seen.step);
    if (value < 0) {
      cells[seen.cell] = std::max(cells[seen.cell] + value, -limit);
    }
  }
  for (const CellEvidence& seen : evidence.cells) {
    const std::int32_t value = at(values, seen.step);
    if (value > 0) {
      std::int32_t& cell = cells[seen.cell];
      cell = std::min((hits_win ? std::max(cell, 0) : cell) + value, limit);
    }
  }
  return cells;
}

std::vector<double> fuse_bayes(const FrameEvidence& evidence, const ByStep<double>& values) {
  std::vector<double> cells(geometry::kCellCount, 0.5);
  for (const CellEvidence& seen : evidence.cells) {
    cells[seen.cell] = reference::fuse_bayes(cells[seen.cell], at(values, seen.step));
  }
  return cells;
}

std::vector<double> fuse_log_odds(const FrameEvidence& evidence, const ByStep<double>& values) {
  ByStep<double> log_odds{};
  std::ranges::transform(values, log_odds.begin(), reference::log_odds);
  std::vector<double> cells(geometry::kCellCount);
  for (const CellEvidence& seen : evidence.cells) {
    cells[seen.cell] += at(log_odds, seen.step);
  }
  std::ranges::transform(cells, cells.begin(), [](double sum) {
    return sum == 0 ? 0.5 : reference::probability_of_log_odds(sum);
  });
  return cells;
}

// Whether this value says anything of a cell.
bool is_measurement(double probability) { return std::abs(probability - 0.5) > kSaysNothing; }

std::vector<double> fuse_linear_opinion_pool(const FrameEvidence& evidence,
                                             const ByStep<double>& values) {
  std::vector<double> cells(geometry::kCellCount);
  std::vector<std::uint32_t> counts(geometry::kCellCount);
  for (const CellEvidence& seen : evidence.cells) {
    if (const double value = at(values, seen.step); is_measurement(value)) {
      cells[seen.cell] += value;
      ++counts[seen.cell];
    }
  }
  std::ranges::transform(cells, counts, cells.begin(), [](double sum, std::uint32_t count) {
    return count == 0 ? 0.5 : sum / count;
  });
  return cells;
}

std::vector<double> fuse_maximum(const FrameEvidence& evidence, const ByStep<double>& values) {
  std::vector<double> cells(geometry::kCellCount);
  for (const CellEvidence& seen : evidence.cells) {
    if (const double value = at(values, seen.step); is_measurement(value)) {
      cells[seen.cell] = reference::fuse_maximum(cells[seen.cell], value);
    }
  }
  std::ranges::replace(cells, 0.0, 0.5);  // no measurement is 0
  return cells;
}

}  // namespace

std::vector<std::int32_t> fuse_indexes(const FrameEvidence& evidence,
                                       const ByStep<std::int32_t>& values, IndexRule rule,
                                       std::int32_t limit) {
  return rule == IndexRule::kSequential
             ? fuse_in_order(evidence, values, limit)
             : fuse_by_sign(evidence, values, rule == IndexRule::kHitsWin, limit);
}

std::vector<double> fuse_probabilities(const FrameEvidence& evidence, const ByStep<double>& values,
                                       ProbabilityRule rule) {
  switch (rule) {
    case ProbabilityRule::kBayes:
      return fuse_bayes(evidence, values);
    case ProbabilityRule::kLogOdds:
      return fuse_log_odds(evidence, values);
    case ProbabilityRule::kLinearOpinionPool:
      return fuse_linear_opinion_pool(evidence, values);
    case ProbabilityRule::kMaximum:
      return fuse_maximum(evidence, values);
  }
  return {};
}

}  // namespace iog::lab
