// Cells and tiles of the grid: numbers and places are each other's inverse, on a grid of any size.
#include "geometry/grid.hpp"

#include <gtest/gtest.h>

namespace iog::geometry {
namespace {

TEST(Grid, CellsAreNumberedRowByRowFromTheLowestY) {
  EXPECT_EQ(cell_of(0), (Cell{0, 0}));
  EXPECT_EQ(cell_of(1), (Cell{1, 0}));
  EXPECT_EQ(cell_of(kCellsPerSide), (Cell{0, 1}));
  EXPECT_EQ(cell_of(kCellCount - 1), (Cell{kCellsPerSide - 1, kCellsPerSide - 1}));
  for (std::size_t number = 0; number < kCellCount; number += 97) {
    ASSERT_EQ(static_cast<std::size_t>(number_of(cell_of(number))), number);
  }
}

// docs/spec.md: tiles of 32 by 32 cells.
TEST(Grid, EveryTileHasItsCellsAndNoOthers) {
  EXPECT_EQ(kTileSide, 32U);
  EXPECT_EQ(tile_of({31, 31}), 0U);
  EXPECT_EQ(tile_of({32, 31}), 1U);
  EXPECT_EQ(tile_of({31, 32}), kTilesPerSide);
  EXPECT_EQ(tile_of(cell_of(kCellCount - 1)), kTileCount - 1);
  static std::array<std::size_t, kTileCount> cells{};
  for (std::size_t number = 0; number < kCellCount; ++number) {
    ++cells[tile_of(cell_of(number))];
  }
  for (const std::size_t count : cells) {
    ASSERT_EQ(count, kTileCells);
  }
}

TEST(Grid, ItsAreaIsThatOfItsCells) {
  EXPECT_TRUE(kGridArea.contains({0, 0}));
  EXPECT_TRUE(kGridArea.contains(cell_of(kCellCount - 1)));
  EXPECT_FALSE(kGridArea.contains({-1, 0}));
  EXPECT_FALSE(kGridArea.contains({0, -1}));
  EXPECT_FALSE(kGridArea.contains({kCellsPerSide, 0}));
  EXPECT_FALSE(kGridArea.contains({0, kCellsPerSide}));
}

// 16 x 10 tiles of the memory's 32 x 32, counted one by one.
TEST(Grid, TilesOfARectangleAreNumberedRowByRow) {
  constexpr Grid kGrid{.columns = 512, .rows = 320, .origin_column = 0, .origin_row = 160};
  EXPECT_EQ(kGrid.tile_count(), 160U);
  std::size_t before = 0;
  for (std::size_t tile = 0; tile < kTileCount; ++tile) {
    ASSERT_EQ(kGrid.tiles_before(tile), before) << tile;
    if (tile % kTilesPerSide < 16 && tile / kTilesPerSide < 10) {
      ASSERT_EQ(kGrid.tile_in_memory(before), tile);
      ++before;
    }
  }
  EXPECT_EQ(kGrid.tiles_before(kTileCount), 160U);
  EXPECT_EQ(Grid{}.tiles_before(kTileCount), kTileCount);
  EXPECT_EQ(Grid{}.tiles_before(777), 777U);
}

}  // namespace
}  // namespace iog::geometry
