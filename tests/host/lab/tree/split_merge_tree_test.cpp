// The 2^d-tree of thesis section 3.5, for d = 1 to 4: the laws of its definition, against an array.
#include "lab/tree/split_merge_tree.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::tree {
namespace {

using index::OccupancyIndex;

template <std::size_t kDimensionOf, std::uint32_t kDepthOf>
struct Shape {
  static constexpr std::size_t kDimension = kDimensionOf;
  static constexpr std::uint32_t kDepth = kDepthOf;
  static constexpr std::size_t kWorst = SplitMergeTree<kDimension, kDepth, 0>::max_splits();
  using Tree = SplitMergeTree<kDimension, kDepth, kWorst>;
};

template <typename TreeShape>
class SplitMergeTreeTest : public testing::Test {
 protected:
  static constexpr std::size_t kDimension = TreeShape::kDimension;
  static constexpr std::uint32_t kDepth = TreeShape::kDepth;
  static constexpr std::uint32_t kCells = 1U << (kDimension * kDepth);

  void set(std::uint32_t place, OccupancyIndex index) {
    ASSERT_EQ(tree_.set(morton_cell<kDimension>(place), index), Update::kDone);
    cells_[place] = index;
  }

  // The index of all cells of the block of this side around a place, or that there are several.
  [[nodiscard]] bool is_uniform(std::uint32_t place, std::uint32_t side_log2) const {
    const std::uint32_t size = 1U << (kDimension * side_log2);
    const std::uint32_t first = place / size * size;
    for (std::uint32_t cell = first; cell < first + size; ++cell) {
      if (cells_[cell] != cells_[first]) {
        return false;
      }
    }
    return true;
  }

  // Definition 3.5.2 (every cell in one leaf), 3.5.3 (with its index), and no (3.47) left over: the
  // block around a leaf is not uniform.
  void expect_the_leaves_of_the_cells() {
    std::uint32_t place = 0;
    std::size_t leaves = 0;
    tree_.for_each_leaf([&](const Leaf<kDimension>& leaf) {
      EXPECT_EQ(leaf.block.corner, morton_cell<kDimension>(place));
      EXPECT_EQ(leaf.index, cells_[place]);
      EXPECT_TRUE(is_uniform(place, leaf.block.side_log2));
      EXPECT_TRUE(leaf.block.side_log2 == kDepth || !is_uniform(place, leaf.block.side_log2 + 1));
      place += 1U << (kDimension * leaf.block.side_log2);
      ++leaves;
    });
    EXPECT_EQ(place, kCells);
    EXPECT_EQ(tree_.leaves(), leaves);
  }

  typename TreeShape::Tree tree_;
  std::vector<OccupancyIndex> cells_ = std::vector<OccupancyIndex>(kCells);
};

using Shapes = testing::Types<Shape<1, 6>, Shape<2, 4>, Shape<3, 3>, Shape<4, 2>>;
TYPED_TEST_SUITE(SplitMergeTreeTest, Shapes);

TYPED_TEST(SplitMergeTreeTest, IsOneUnknownLeafAtFirst) {
  EXPECT_EQ(this->tree_.leaves(), 1U);
  EXPECT_EQ(this->tree_.nodes(), 1U);
  this->expect_the_leaves_of_the_cells();
}

// Figure 3.12: a leaf is split down to the largest depth, and at each depth 2^d - 1 parts stay.
TYPED_TEST(SplitMergeTreeTest, ACellSplitsEveryBlockAroundIt) {
  this->set(3, -14);
  EXPECT_EQ(this->tree_.nodes(), 1 + this->kDepth * (1U << this->kDimension));
  EXPECT_EQ(this->tree_.leaves(), 1 + this->kDepth * ((1U << this->kDimension) - 1));
  this->expect_the_leaves_of_the_cells();
}

// Figure 3.13: merging goes on upwards as long as (3.47) holds.
TYPED_TEST(SplitMergeTreeTest, EqualCellsMergeUpToTheRoot) {
  this->set(3, -14);
  this->set(3, 0);
  EXPECT_EQ(this->tree_.nodes(), 1U);
  for (std::uint32_t place = 0; place < this->kCells; ++place) {
    this->set(place, 5);
  }
  EXPECT_EQ(this->tree_.nodes(), 1U);
  this->expect_the_leaves_of_the_cells();
}

TYPED_TEST(SplitMergeTreeTest, AlternatingCellsAreAllLeavesAndNoneIsRefused) {
  for (std::uint32_t place = 0; place < this->kCells; ++place) {
    this->set(place, place % 2 == 0 ? 127 : -127);
  }
  EXPECT_EQ(this->tree_.leaves(), this->kCells);
  EXPECT_EQ(this->tree_.refused(), 0U);
  this->expect_the_leaves_of_the_cells();
}

TYPED_TEST(SplitMergeTreeTest, FollowsAnArrayThroughRandomUpdates) {
  tests::Random random(this->kDimension);
  for (int round = 0; round < tests::effort(40, 4); ++round) {
    for (int update = 0; update < 200; ++update) {
      this->set(static_cast<std::uint32_t>(random.below(this->kCells)),
                static_cast<OccupancyIndex>(random.between(-1, 1)));
    }
    this->expect_the_leaves_of_the_cells();
  }
  this->tree_.clear();
  EXPECT_EQ(this->tree_.nodes(), 1U);
}

// Figure 3.11 has a grid of 64 cells in a tree of 13 nodes: three splits, as one cell makes them.
TEST(SplitMergeTree, ThirteenNodesStandForSixtyFourCells) {
  SplitMergeTree<2, 3, 3> tree;
  ASSERT_EQ(tree.set({5, 2}, 1), Update::kDone);
  EXPECT_EQ(tree.nodes(), 13U);
  EXPECT_EQ(tree.leaves(), 10U);
  EXPECT_EQ(tree.leaf_at({5, 2}), (Leaf<2>{{{5, 2}, 0}, 1}));
  EXPECT_EQ(tree.leaf_at({4, 1}), (Leaf<2>{{{4, 0}, 1}, 0}));
  EXPECT_EQ(tree.leaf_at({3, 7}), (Leaf<2>{{{0, 4}, 2}, 0}));
}

TEST(SplitMergeTree, RefusesWhatFindsNoRoomAndStaysAsItWas) {
  SplitMergeTree<2, 3, 4> tree;
  ASSERT_EQ(tree.set({0, 0}, 1), Update::kDone);
  EXPECT_EQ(tree.set({7, 7}, 1), Update::kNoRoom);
  EXPECT_EQ(tree.refused(), 1U);
  EXPECT_EQ(tree.leaf_at({7, 7}).index, 0);
  EXPECT_EQ(tree.leaves(), 10U);
  ASSERT_EQ(tree.set({2, 0}, 1), Update::kDone);  // needs the last split
  ASSERT_EQ(tree.set({2, 0}, 0), Update::kDone);
  ASSERT_EQ(tree.set({0, 0}, 0), Update::kDone);
  EXPECT_EQ(tree.set({7, 7}, 1), Update::kDone);
  EXPECT_EQ(tree.leaf_at({7, 7}).index, 1);
}

// The sum of two indexes saturates at 127 (docs/model.md section 2).
TEST(SplitMergeTree, FusesByASaturatedSum) {
  SplitMergeTree<3, 1, 1> octree;
  ASSERT_EQ(octree.add({1, 0, 1}, 100), Update::kDone);
  ASSERT_EQ(octree.add({1, 0, 1}, 100), Update::kDone);
  ASSERT_EQ(octree.add({0, 0, 1}, -14), Update::kDone);
  EXPECT_EQ(octree.leaf_at({1, 0, 1}).index, 127);
  EXPECT_EQ(octree.leaf_at({0, 0, 1}).index, -14);
  EXPECT_EQ(octree.leaves(), 8U);
}

}  // namespace
}  // namespace iog::tree
