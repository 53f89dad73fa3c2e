// The grid in memory: every cell has its place, and a tile is the square of cells that its number
// says.
#include "grid/block_grid.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

namespace iog::grid {
namespace {

using geometry::Cell;
using TileCells = std::array<OccupancyIndex, geometry::kTileCells>;

std::unique_ptr<BlockGrid> empty_grid() { return std::make_unique<BlockGrid>(); }

void set(BlockGrid& grid, Cell cell, OccupancyIndex index) {
  grid.cell_at(offset_of(cell, kBlockStride)) = index;
}

bool is_known(const BlockGrid& grid, std::size_t tile) {
  TileCells cells;
  return grid.copy_tile(tile, cells);
}

TEST(BlockGrid, EveryCellHasAPlaceOfItsOwn) {
  std::vector<std::uint32_t> offsets;
  for (std::size_t number = 0; number < geometry::kCellCount; ++number) {
    offsets.push_back(offset_of(geometry::cell_of(number), kBlockStride));
  }
  std::ranges::sort(offsets);
  EXPECT_EQ(std::ranges::adjacent_find(offsets), offsets.end());
  EXPECT_LT(offsets.back(), sizeof(LaneBytes) * kBlocksPerSide * kBlockStride);
}

// Sixteen bytes of a block: 4 by 4 cells, from the lowest y row by row.
TEST(BlockGrid, ABlockIsASquareOfCells) {
  const std::uint32_t first = offset_of({36, 72}, kBlockStride);
  EXPECT_EQ(first % kLaneCount, 0U);
  EXPECT_EQ(offset_of({37, 72}, kBlockStride), first + 1);
  EXPECT_EQ(offset_of({36, 73}, kBlockStride), first + 4);
  EXPECT_EQ(offset_of({39, 75}, kBlockStride), first + 15);
}

// A line of cells along y must not compete for a few sets of a cache of 256 sets of 32 bytes.
TEST(BlockGrid, TheBlocksOfAColumnLieInDifferentSetsOfTheCache) {
  std::vector<std::uint32_t> sets;
  for (std::int32_t y = 0; y < std::min<std::int32_t>(geometry::kCellsPerSide, 1024);
       y += kBlockSide) {
    sets.push_back(offset_of({512, y}, kBlockStride) / 32 % 256);
  }
  std::ranges::sort(sets);
  EXPECT_EQ(std::ranges::adjacent_find(sets), sets.end());
}

// One known cell, in each corner of a tile.
TEST(BlockGrid, ATileIsKnownIfOneOfItsCellsIs) {
  for (const std::int32_t x : {64, 95}) {
    for (const std::int32_t y : {96, 127}) {
      const auto grid = empty_grid();
      set(*grid, {x, y}, -1);
      for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
        ASSERT_EQ(is_known(*grid, tile), tile == 3 * geometry::kTilesPerSide + 2) << tile;
      }
    }
  }
}

TEST(BlockGrid, ATileIsCopiedRowByRowFromItsLowestY) {
  const auto grid = empty_grid();
  constexpr std::int32_t kSide = geometry::kTileSide;
  for (std::int32_t i = 0; i < kSide * kSide; ++i) {
    set(*grid, {992 + i % kSide, 960 + i / kSide}, static_cast<OccupancyIndex>(i % 255 - 127));
  }
  TileCells cells;
  ASSERT_TRUE(grid->copy_tile(30 * geometry::kTilesPerSide + 31, cells));
  for (std::size_t i = 0; i < geometry::kTileCells; ++i) {
    ASSERT_EQ(int{cells[i]}, static_cast<int>(i % 255) - 127) << i;
  }
}

// Carving has its floor at -128, an index at -127.
TEST(BlockGrid, TheLowestByteReadsAsTheLowestIndex) {
  const auto grid = empty_grid();
  set(*grid, {40, 40}, -128);
  set(*grid, {41, 40}, -127);
  EXPECT_EQ(int{grid->at({40, 40})}, -127);
  EXPECT_EQ(int{grid->at({41, 40})}, -127);
  TileCells cells;
  ASSERT_TRUE(grid->copy_tile(geometry::kTilesPerSide + 1, cells));
  EXPECT_EQ(int{cells[8 * geometry::kTileSide + 8]}, -127);
  EXPECT_EQ(int{cells[8 * geometry::kTileSide + 9]}, -127);
}

TEST(BlockGrid, ClearingATileLeavesItsNeighboursAlone) {
  const auto grid = empty_grid();
  for (std::size_t number = 0; number < geometry::kCellCount; ++number) {
    set(*grid, geometry::cell_of(number), 3);
  }
  constexpr std::size_t kTile = 5 * geometry::kTilesPerSide + 4;
  grid->touch(kTile);
  grid->touch(kTile + 1);
  grid->clear_tile(kTile);
  std::size_t unknown = 0;
  for (std::size_t number = 0; number < geometry::kCellCount; ++number) {
    const Cell cell = geometry::cell_of(number);
    const bool is_inside = geometry::tile_of(cell) == kTile;
    ASSERT_EQ(int{grid->at(cell)}, is_inside ? 0 : 3);
    unknown += is_inside ? 1U : 0U;
  }
  EXPECT_EQ(unknown, geometry::kTileCells);
  EXPECT_FALSE(grid->is_touched(kTile));
  EXPECT_TRUE(grid->is_touched(kTile + 1));
}

}  // namespace
}  // namespace iog::grid
