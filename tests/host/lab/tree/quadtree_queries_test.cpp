// What a quadtree is asked: the block around a cell, and whether a rectangle is free, both against
// the array.
#include <gtest/gtest.h>
#include <utility>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "lab/tree/built_quadtree.hpp"
#include "lab/tree/grid_drawing.hpp"
#include "lab/tree/linear_quadtree.hpp"

namespace iog::tree {
namespace {

using index::OccupancyIndex;
using tests::BuiltQuadtree;
using tests::effort;
using tests::GridDrawing;
using tests::Random;

constexpr auto kSide = static_cast<std::int32_t>(kGridSide);

OccupancyIndex at(const GridDrawing& grid, std::int32_t x, std::int32_t y) {
  const bool is_inside = 0 <= x && x < kSide && 0 <= y && y < kSide;
  return is_inside ? grid.at(static_cast<std::size_t>(x), static_cast<std::size_t>(y))
                   : index::kUnknown;
}

bool is_free(const GridDrawing& grid, const Rectangle& rectangle) {
  for (std::int32_t y = rectangle.y; y < rectangle.y + rectangle.height; ++y) {
    for (std::int32_t x = rectangle.x; x < rectangle.x + rectangle.width; ++x) {
      if (at(grid, x, y) >= 0) {
        return false;
      }
    }
  }
  return true;
}

// A free street with a few things on it, of blocks of all sizes.
GridDrawing street(Random& random) {
  GridDrawing grid = GridDrawing().fill(
      [](std::size_t, std::size_t y) { return static_cast<OccupancyIndex>(y < 700 ? -42 : 0); });
  for (int thing = 0; thing < 300; ++thing) {
    const std::size_t side = 1 + random.below(12);
    const std::size_t x = random.below(1000);
    const std::size_t y = random.below(1000);
    const auto index = static_cast<OccupancyIndex>(random.between(-60, 20));
    grid.fill(x, y, side, side, [index](std::size_t, std::size_t) { return index; });
  }
  return grid;
}

TEST(QuadtreeQueries, TheLeafAtEveryCellIsTheOneThatHoldsIt) {
  Random random(1);
  const GridDrawing grid = street(random);
  const BuiltQuadtree built = tests::quadtree_of(grid);
  built->for_each_leaf([&built, &random](const Leaf<2>& leaf) {
    const auto side = static_cast<std::size_t>(1) << leaf.block.side_log2;
    const auto x = static_cast<std::uint32_t>(random.below(side));
    const auto y = static_cast<std::uint32_t>(random.below(side));
    const Cell<2> low = leaf.block.corner;
    EXPECT_EQ(built->leaf_at(low), leaf);
    EXPECT_EQ(built->leaf_at({low[0] + x, low[1] + y}), leaf);
  });
}

TEST(QuadtreeQueries, TheIndexAtEveryCellIsThatOfTheArray) {
  Random random(2);
  const GridDrawing grid = street(random);
  const BuiltQuadtree built = tests::quadtree_of(grid);
  constexpr auto kStep = static_cast<std::uint32_t>(effort(1, 7));
  std::size_t different = 0;
  for (std::uint32_t y = 0; y < kGridSide; y += kStep) {
    for (std::uint32_t x = 0; x < kGridSide; x += kStep) {
      different += std::size_t{built->leaf_at({x, y}).index != grid.at(x, y)};
    }
  }
  EXPECT_EQ(different, 0U);
}

TEST(QuadtreeQueries, ARectangleIsFreeIfAllItsCellsAre) {
  Random random(3);
  const GridDrawing grid = street(random);
  const BuiltQuadtree built = tests::quadtree_of(grid);
  int free = 0;
  const int trials = effort(20'000, 1'000);
  for (int trial = 0; trial < trials; ++trial) {
    const Rectangle rectangle{.x = random.between(-10, kSide),
                              .y = random.between(-10, kSide),
                              .width = random.between(0, 60),
                              .height = random.between(0, 60)};
    const bool expected = is_free(grid, rectangle);
    ASSERT_EQ(built->is_free(rectangle), expected)
        << rectangle.x << ' ' << rectangle.y << ' ' << rectangle.width << ' ' << rectangle.height;
    free += expected ? 1 : 0;
  }
  EXPECT_GT(free, trials / 10);  // both answers were asked for
  EXPECT_LT(free, trials / 10 * 9);
}

// One cell that is not free is found by every rectangle that holds it and by none that does not.
TEST(QuadtreeQueries, ACellSpoilsExactlyTheRectanglesThatHoldIt) {
  for (const auto& [x, y] : {std::pair{31, 32}, std::pair{48, 15}, std::pair{511, 512}}) {
    GridDrawing grid =
        GridDrawing().fill([](std::size_t, std::size_t) { return OccupancyIndex{-1}; });
    grid.set(static_cast<std::size_t>(x), static_cast<std::size_t>(y), 0);
    const BuiltQuadtree built = tests::quadtree_of(grid);
    EXPECT_FALSE(built->is_free({x, y, 1, 1}));
    EXPECT_FALSE(built->is_free({x - 10, y - 10, 11, 11}));
    EXPECT_FALSE(built->is_free({0, 0, kSide, kSide}));
    EXPECT_TRUE(built->is_free({x - 10, y - 10, 10, 21}));
    EXPECT_TRUE(built->is_free({x + 1, y - 10, 10, 21}));
    EXPECT_TRUE(built->is_free({0, y + 1, kSide, kSide - y - 1}));
    EXPECT_TRUE(built->is_free({0, 0, kSide, y}));
  }
}

TEST(QuadtreeQueries, OutsideOfTheGridNothingIsFree) {
  const GridDrawing grid =
      GridDrawing().fill([](std::size_t, std::size_t) { return OccupancyIndex{-127}; });
  const BuiltQuadtree built = tests::quadtree_of(grid);
  EXPECT_TRUE(built->is_free({0, 0, kSide, kSide}));
  EXPECT_FALSE(built->is_free({-1, 0, 2, 2}));
  EXPECT_FALSE(built->is_free({0, kSide - 1, 2, 2}));
  EXPECT_FALSE(built->is_free({kSide, 0, 1, 1}));
  EXPECT_FALSE(built->is_free({1, 1, INT32_MAX, INT32_MAX}));
  EXPECT_FALSE(built->is_free({INT32_MAX, INT32_MIN, 1, 1}));
  EXPECT_TRUE(built->is_free({-5, -5, 0, 10}));  // no cell at all
}

}  // namespace
}  // namespace iog::tree
