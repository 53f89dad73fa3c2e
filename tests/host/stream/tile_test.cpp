#include "stream/tile.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

namespace iog::stream {
namespace {

using Grid = std::array<index::OccupancyIndex, grid::kCellCount>;

std::unique_ptr<Grid> empty_grid() { return std::make_unique<Grid>(); }

index::OccupancyIndex& cell(Grid& grid, std::size_t x, std::size_t y) {
  return grid[y * grid::kStride + x];
}

// One known cell, in each corner of a tile and beside it.
TEST(Tile, IsKnownIfOneOfItsCellsIs) {
  for (const std::size_t x : {64U, 95U}) {
    for (const std::size_t y : {96U, 127U}) {
      const auto grid = empty_grid();
      cell(*grid, x, y) = -1;
      for (std::size_t tile_y = 0; tile_y < kTilesPerSide; ++tile_y) {
        for (std::size_t tile_x = 0; tile_x < kTilesPerSide; ++tile_x) {
          ASSERT_EQ(is_known(*grid, tile_x, tile_y), tile_x == 2 && tile_y == 3);
        }
      }
    }
  }
}

TEST(Tile, CarriesItsCellsRowByRowFromTheLowestY) {
  const auto grid = empty_grid();
  cell(*grid, 1023, 992) = 5;   // lower right cell of the tile (31, 31)
  cell(*grid, 992, 1023) = -7;  // its upper left cell
  std::array<std::byte, kTileBytes> tile{};
  copy_tile(*grid, 31, 31, tile);
  EXPECT_EQ(tile[31], std::byte{5});
  EXPECT_EQ(tile[kTileSide * 31], std::byte{0xF9});
  EXPECT_EQ(std::ranges::count(tile, std::byte{0}), 1022);
}

TEST(Tile, ClearingOneLeavesItsNeighboursAlone) {
  const auto grid = empty_grid();
  grid->fill(3);
  clear_tile(*grid, 4, 5);
  EXPECT_EQ(std::ranges::count(*grid, index::OccupancyIndex{0}), 1024);
  EXPECT_FALSE(is_known(*grid, 4, 5));
  EXPECT_TRUE(is_known(*grid, 3, 5));
  EXPECT_TRUE(is_known(*grid, 4, 6));
}

// python3: zlib.crc32(bytes([0, 4, 0, 5]) + bytes([3]) * 1024)
TEST(GridHash, IsTheCrcOfPlaceAndCells) {
  std::array<std::byte, kTileBytes> tile{};
  tile.fill(std::byte{3});
  GridHash hash;
  EXPECT_EQ(hash.value(), 0U);
  hash.add(4, 5, tile);
  EXPECT_EQ(hash.value(), 0xAB6383F9U);
}

}  // namespace
}  // namespace iog::stream
