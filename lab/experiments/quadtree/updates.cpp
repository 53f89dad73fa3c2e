#include "lab/experiments/quadtree/updates.hpp"

namespace iog::lab {
namespace {

constexpr std::uint32_t kStride = geometry::kCellsPerSide;

tree::Cell<2> cell_of(std::uint32_t number) { return {number % kStride, number / kStride}; }

}  // namespace

TreeFusion::TreeFusion() : tree_(std::make_unique<SplitMergeQuadtree>()) {}

// An update that changes the index of a leaf splits it down to the cell, once for each halving of
// its side, and then merges upwards, once for each doubling.
TreeUpdates TreeFusion::fuse(const FrameEvidence& evidence, const ByStep<std::int32_t>& values) {
  TreeUpdates counted;
  tree_->clear();
  for (const CellEvidence& seen : evidence.cells) {
    const tree::Cell<2> cell = cell_of(seen.cell);
    const auto value = static_cast<index::OccupancyIndex>(values[slot_of(seen.step)]);
    const tree::Leaf<2> before = tree_->leaf_at(cell);
    static_cast<void>(tree_->add(cell, value));
    const tree::Leaf<2> after = tree_->leaf_at(cell);
    if (after.index != before.index) {
      ++counted.updates;
      counted.splits += before.block.side_log2;
      counted.merges += after.block.side_log2;
    }
  }
  counted.leaves = tree_->leaves();
  const auto array = fuse_indexes(evidence, values, IndexRule::kSequential, kInt8Limit);
  for (std::uint32_t cell = 0; cell < geometry::kCellCount; ++cell) {
    counted.differing_cells += tree_->leaf_at(cell_of(cell)).index == array[cell] ? 0U : 1U;
  }
  return counted;
}

}  // namespace iog::lab
