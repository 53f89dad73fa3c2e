// The trees that the experiment on quadtrees builds, and whether its check would see a difference.
#include <algorithm>
#include <cstddef>
#include <span>
#include <vector>

#include "gtest/gtest.h"

#include "lab/experiments/quadtree/grids.hpp"
#include "lab/experiments/quadtree/pair.hpp"

namespace iog::lab {
namespace {

using Leaf = tree::Leaf<2>;

constexpr std::size_t kSide = tree::kGridSide;

class GridTest : public testing::Test {
 protected:
  [[nodiscard]] GridCells cells() const { return std::span(cells_).first<geometry::kCellCount>(); }
  void set(std::size_t x, std::size_t y, index::OccupancyIndex index) {
    cells_[y * kSide + x] = index;
  }

 private:
  std::vector<index::OccupancyIndex> cells_ = std::vector<index::OccupancyIndex>(kSide * kSide);
};

// The four quadrants, the last of them of another index.
std::vector<Leaf> quadrants() {
  return {{{{0, 0}, 9}, 0}, {{{512, 0}, 9}, 0}, {{{0, 512}, 9}, 0}, {{{512, 512}, 9}, -14}};
}

using DrawnLeaves = GridTest;

TEST_F(DrawnLeaves, AreTheCellsOfTheirGrid) {
  for (std::size_t y = 512; y < kSide; ++y) {
    for (std::size_t x = 512; x < kSide; ++x) {
      set(x, y, -14);
    }
  }
  EXPECT_EQ(differing_cells(quadrants(), cells()), 0U);
  set(1023, 1023, -13);
  EXPECT_EQ(differing_cells(quadrants(), cells()), 1U);
}

TEST_F(DrawnLeaves, AreNotIfACellIsInNoneOrInTwo) {
  EXPECT_EQ(differing_cells({{{{0, 0}, 10}, 0}}, cells()), 0U);
  EXPECT_EQ(differing_cells({}, cells()), kSide * kSide);
  EXPECT_EQ(differing_cells({{{{0, 0}, 10}, 0}, {{{3, 3}, 0}, 0}}, cells()), 1U);
}

using QuadtreePairTest = GridTest;

// Ten blocks are split, from the grid down to two by two cells: 3 leaves more each time. Five of
// them are in the cell's tile: its 16 leaves are a byte each, its shape is 52, each tile's entry 4.
TEST_F(QuadtreePairTest, OfOneCellHasThirtyOneLeaves) {
  set(700, 3, 2);
  const QuadtreeSize size = QuadtreePair().build(cells(), "one cell");
  EXPECT_EQ(size.leaves, 31U);
  EXPECT_EQ(size.nodes, 41U);
  EXPECT_EQ(size.linear_bytes, 1024U * 4 + 52 + 16);
  EXPECT_EQ(size.reference_bytes, 41U * 5);
  EXPECT_EQ(size.differing_cells, 0U);
  EXPECT_EQ(size.differing_leaves, 0U);
}

TEST_F(QuadtreePairTest, HasNothingOfTheGridBefore) {
  QuadtreePair trees;
  set(700, 3, 2);
  static_cast<void>(trees.build(cells(), "one cell"));
  set(700, 3, 0);
  EXPECT_EQ(trees.build(cells(), "no cell").leaves, 1U);
}

// One leaf, one leaf, any number, 16 a tile, and one a cell.
TEST(DrawnGrids, HaveTheLeavesThatTheirNamesSay) {
  const std::vector<NamedGrid> grids = drawn_grids(1);
  ASSERT_EQ(grids.size(), 5U);
  QuadtreePair trees;
  const auto leaves = [&](std::size_t number) {
    const auto cells = std::span(grids[number].cells).first<geometry::kCellCount>();
    return trees.build(cells, grids[number].name).leaves;
  };
  EXPECT_EQ(leaves(0), 1U);
  EXPECT_EQ(leaves(1), 1U);
  EXPECT_EQ(leaves(3), 16U * 1024);
  EXPECT_EQ(leaves(4), kSide * kSide);
  const auto& singles = grids[2].cells;
  EXPECT_EQ(std::count(singles.begin(), singles.end(), 2), 1000);
  EXPECT_EQ(std::count(singles.begin(), singles.end(), 0), (1 << 20) - 1000);
}

}  // namespace
}  // namespace iog::lab
