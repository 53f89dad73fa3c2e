#include "lab/evidence/fusion_rules.hpp"

#include <algorithm>

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

}  // namespace

std::vector<std::int32_t> fuse_indexes(const FrameEvidence& evidence,
                                       const ByStep<std::int32_t>& values, IndexRule rule,
                                       std::int32_t limit) {
  return rule == IndexRule::kSequential
             ? fuse_in_order(evidence, values, limit)
             : fuse_by_sign(evidence, values, rule == IndexRule::kHitsWin, limit);
}

std::vector<double> fuse_probabilities(const FrameEvidence& evidence,
                                       const ByStep<double>& values) {
  std::vector<double> cells(geometry::kCellCount, 0.5);
  for (const CellEvidence& seen : evidence.cells) {
    cells[seen.cell] = reference::fuse_bayes(cells[seen.cell], at(values, seen.step));
  }
  return cells;
}

}  // namespace iog::lab
