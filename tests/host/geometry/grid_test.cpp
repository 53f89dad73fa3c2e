// Cells and tiles of the grid: numbers and places are each other's inverse, on a grid of any size.
#include "geometry/grid.hpp"

#include <algorithm>
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

// Any rectangle of at most 1,024 tiles, counted one by one.
TEST(Grid, TilesOfARectangleAreNumberedRowByRow) {
  constexpr std::uint16_t kSide = kTileSide;
  for (std::uint16_t across = 1; across <= 128; ++across) {
    const auto up = static_cast<std::uint16_t>(std::min<std::size_t>(128, kTileCount / across));
    const Grid grid{.columns = static_cast<std::uint16_t>(across * kSide),
                    .rows = static_cast<std::uint16_t>(up * kSide),
                    .origin_column = 0,
                    .origin_row = 0};
    EXPECT_TRUE(grid.fits());
    const TileRows rows(grid);
    std::size_t tile = 0;
    for (std::int32_t y = 0; y < up; ++y) {
      for (std::int32_t x = 0; x < across; ++x, ++tile) {
        ASSERT_EQ(rows.place_of(tile), (Cell{x, y})) << across;
        ASSERT_EQ(tile_of({x * kSide + 31, y * kSide}, grid.tiles_across()), tile) << across;
      }
    }
    EXPECT_EQ(grid.tile_count(), tile);
  }
}

TEST(Grid, FitsIntoTheMemory) {
  EXPECT_TRUE((Grid{.columns = 1056, .rows = 992}).fits());
  EXPECT_FALSE((Grid{.columns = 1056, .rows = 1024}).fits());
  EXPECT_TRUE((Grid{.columns = 4096, .rows = 256, .origin_row = 256}).fits());
  EXPECT_FALSE((Grid{.columns = 4128, .rows = 32, .origin_row = 0}).fits());
  EXPECT_FALSE((Grid{.columns = 512, .rows = 2047}).fits());
  EXPECT_FALSE((Grid{.rows = 0, .origin_row = 0}).fits());
  EXPECT_FALSE((Grid{.columns = 480}).fits());  // the origin is farther than that
}

}  // namespace
}  // namespace iog::geometry
