// The linear quadtree: the leaves of the thesis's tree, and cell for cell the array (section
// 4.3.2.2, "lossless compaction").
#include "lab/tree/linear_quadtree.hpp"

#include <gtest/gtest.h>
#include <memory>
#include <numeric>
#include <utility>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "lab/tree/built_quadtree.hpp"
#include "lab/tree/grid_drawing.hpp"
#include "lab/tree/split_merge_tree.hpp"

namespace iog::tree {
namespace {

using index::OccupancyIndex;
using tests::BuiltQuadtree;
using tests::effort;
using tests::GridDrawing;
using tests::Random;

constexpr std::size_t kSide = GridDrawing::kSide;

using Reference =
    SplitMergeTree<2, kGridSideLog2, SplitMergeTree<2, kGridSideLog2, 0>::max_splits()>;

std::vector<Leaf<2>> leaves_of(const auto& tree) {
  std::vector<Leaf<2>> leaves;
  tree.for_each_leaf([&leaves](const Leaf<2>& leaf) { leaves.push_back(leaf); });
  return leaves;
}

void expect_equal_cells(const LinearQuadtree& tree, const GridDrawing& grid) {
  GridDrawing painted;
  tree.for_each_leaf([&painted](const Leaf<2>& leaf) {
    const std::size_t side = std::size_t{1} << leaf.block.side_log2;
    painted.fill(leaf.block.corner[0], leaf.block.corner[1], side, side,
                 [&leaf](std::size_t, std::size_t) { return leaf.index; });
  });
  EXPECT_EQ(painted.cells(), grid.cells());
}

// The whole law. The reference takes the cells one by one, as fusion would.
void expect_leaves_of_the_reference(const GridDrawing& grid) {
  const BuiltQuadtree built = tests::quadtree_of(grid);
  const auto reference = std::make_unique<Reference>();
  for (std::uint32_t y = 0; y < kSide; ++y) {
    for (std::uint32_t x = 0; x < kSide; ++x) {
      if (grid.at(x, y) != 0) {
        ASSERT_EQ(reference->set({x, y}, grid.at(x, y)), Update::kDone);
      }
    }
  }
  EXPECT_EQ(leaves_of(*built), leaves_of(*reference));
  EXPECT_EQ(built->leaves(), reference->leaves());
  EXPECT_EQ(built->nodes(), reference->nodes());
  EXPECT_EQ(built->lost_tiles(), 0U);
  expect_equal_cells(*built, grid);
}

GridDrawing uniform(OccupancyIndex index) {
  return GridDrawing().fill([index](std::size_t, std::size_t) { return index; });
}

TEST(LinearQuadtree, IsOneUnknownLeafBeforeItIsBuilt) {
  const BuiltQuadtree built;
  EXPECT_EQ(leaves_of(*built), (std::vector<Leaf<2>>{{{{0, 0}, kGridSideLog2}, 0}}));
  EXPECT_EQ(built->leaves(), 1U);
  EXPECT_EQ(built->nodes(), 1U);
}

TEST(LinearQuadtree, OfOneIndexIsOneLeaf) {
  for (const OccupancyIndex index : {OccupancyIndex{0}, OccupancyIndex{-127}}) {
    const BuiltQuadtree built = tests::quadtree_of(uniform(index));
    EXPECT_EQ(leaves_of(*built), (std::vector<Leaf<2>>{{{{0, 0}, kGridSideLog2}, index}}));
  }
}

// Of a checkerboard every cell is a leaf. It is the most that a tree can need: 4 KiB of entries, 52
// bytes a tile and a byte a cell.
TEST(LinearQuadtree, OfACheckerboardHasEveryCell) {
  const GridDrawing grid = GridDrawing().fill([](std::size_t x, std::size_t y) {
    return static_cast<OccupancyIndex>((x + y) % 2 == 0 ? -14 : 2);
  });
  const BuiltQuadtree built = tests::quadtree_of(grid);
  EXPECT_EQ(built->leaves(), kSide * kSide);
  EXPECT_EQ(built->nodes(), (4 * kSide * kSide - 1) / 3);
  EXPECT_EQ(built->used_bytes(), 4096 + 1024 * 52 + kSide * kSide);
  EXPECT_EQ(built->lost_tiles(), 0U);
  expect_equal_cells(*built, grid);
}

TEST(LinearQuadtree, OfSingleCellsIsThatOfTheReference) {
  Random random(1);
  GridDrawing grid;
  for (int cell = 0; cell < 40; ++cell) {
    grid.set(random.below(kSide), random.below(kSide), 2);
  }
  grid.set(0, 0, -127);
  grid.set(kSide - 1, kSide - 1, 127);
  expect_leaves_of_the_reference(grid);
}

// Uniform blocks of every size, each at places where the tree can merge it and where it cannot.
TEST(LinearQuadtree, OfBlocksOfEverySizeIsThatOfTheReference) {
  for (std::size_t side = 1; side <= 256; side *= 2) {
    GridDrawing grid;
    const auto free = [](std::size_t, std::size_t) { return OccupancyIndex{-14}; };
    grid.fill(256, 0, side, side, free);
    grid.fill(512 + side / 2, 512, side, side, free);
    expect_leaves_of_the_reference(grid);
  }
}

TEST(LinearQuadtree, OfHalfPlanesIsThatOfTheReference) {
  constexpr auto kBorder = static_cast<std::size_t>(effort(517, 77));
  expect_leaves_of_the_reference(GridDrawing().fill([](std::size_t x, std::size_t) {
    return static_cast<OccupancyIndex>(x < kBorder ? -14 : 0);
  }));
  expect_leaves_of_the_reference(GridDrawing().fill([](std::size_t x, std::size_t y) {
    return static_cast<OccupancyIndex>(2 * x + y < kBorder ? 127 : 0);
  }));
}

TEST(LinearQuadtree, OfRandomBlocksIsThatOfTheReference) {
  Random random(2);
  for (int trial = 0; trial < effort(6, 1); ++trial) {
    expect_leaves_of_the_reference(
        tests::random_blocks(random, 500, static_cast<std::size_t>(effort(1024, 256))));
  }
}

TEST(LinearQuadtree, OfRandomCellsIsThatOfTheReference) {
  Random random(3);
  const auto side = static_cast<std::size_t>(effort(1024, 128));
  expect_leaves_of_the_reference(
      GridDrawing().fill(0, 0, side, side, [&random](std::size_t, std::size_t) {
        return static_cast<OccupancyIndex>(random.one_in(9) ? random.between(-127, 127) : -14);
      }));
}

TEST(LinearQuadtree, OfBeamsIsThatOfTheReference) {
  Random random(4);
  expect_leaves_of_the_reference(tests::fan_of_beams(random, effort(800, 60)));
}

// Every frame begins with an unknown grid, whatever was built before.
TEST(LinearQuadtree, HasNothingOfTheFrameBefore) {
  Random random(5);
  const GridDrawing grid = tests::random_blocks(random, 50, kSide);
  const std::vector<Leaf<2>> expected = leaves_of(*tests::quadtree_of(grid));
  BuiltQuadtree built;
  built.build(tests::fan_of_beams(random, 30)).build(uniform(7)).build(grid);
  EXPECT_EQ(leaves_of(*built), expected);
}

// Neither the order of the tiles shows, nor whether an unknown tile was delivered.
TEST(LinearQuadtree, IsTheSameForEveryOrderOfTiles) {
  Random random(6);
  const GridDrawing grid = tests::random_blocks(random, 200, kSide);
  std::vector<std::size_t> order(kTiles);
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t last = order.size(); last > 1; --last) {
    std::swap(order[last - 1], order[random.below(last)]);
  }
  BuiltQuadtree built;
  QuadtreeBuilder builder(built.tree());
  builder.begin();
  for (const std::size_t tile : order) {
    const std::size_t x = tile % kTilesPerSide;
    const std::size_t y = tile / kTilesPerSide;
    ASSERT_EQ(builder.add(x, y, tests::tile_of(grid, x, y)), TileFate::kAdded);
  }
  builder.finish();
  const BuiltQuadtree expected = tests::quadtree_of(grid);
  EXPECT_EQ(leaves_of(*built), leaves_of(*expected));
  EXPECT_EQ(built->used_bytes(), expected->used_bytes());
}

// A tile is only taken while the leaves of any tile would fit. What is lost is unknown, and
// counted.
TEST(LinearQuadtree, WithTooLittleMemoryLosesWholeTiles) {
  GridDrawing grid;
  grid.fill(0, 0, 3 * kTileSide, kTileSide, [](std::size_t x, std::size_t y) {
    return static_cast<OccupancyIndex>((x + y) % 2 == 0 ? -14 : 2);
  });
  BuiltQuadtree built(kLeastLeafBytes + 2 * kTileCells - 1);
  built.build(grid);
  EXPECT_EQ(built.refused(), 1U);
  EXPECT_EQ(built->lost_tiles(), 1U);
  EXPECT_EQ(built->leaf_at({kTileSide, 0}).index, -14);
  EXPECT_EQ(built->leaf_at({2 * kTileSide, 0}),
            (Leaf<2>{{{2 * kTileSide, 0}, kTileSideLog2 + 1}, 0}));
  grid.fill(2 * kTileSide, 0, kTileSide, kTileSide,
            [](std::size_t, std::size_t) { return index::kUnknown; });
  expect_equal_cells(*built, grid);
}

}  // namespace
}  // namespace iog::tree
