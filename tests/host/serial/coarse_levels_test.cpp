// A coarse cell has the highest index of the cells below it, looked up cell by cell.
#include "serial/coarse_levels.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/random.hpp"

namespace iog::serial {
namespace {

using tile_coding::kTileSide;
using Tile = std::array<std::byte, tile_coding::kTileBytes>;

constexpr std::size_t kFineSide = CoarseLevels::kFineTilesPerSide * kTileSide;  // fine cells
constexpr std::size_t kFineCell = geometry::kTilesPerSide * kTileSide / kFineSide;
constexpr std::size_t kRoughCell = geometry::kTilesPerSide;  // cells of the grid along a side

int index_of(std::byte cell) { return static_cast<std::int8_t>(cell); }

// A grid of which some tiles are known.
class CoarseLevelsOf : public testing::Test {
 protected:
  void take(std::size_t tile_x, std::size_t tile_y, const Tile& cells) {
    const std::size_t tile = tile_y * geometry::kTilesPerSide + tile_x;
    levels_.add_tile(tile, cells);
    tiles_[tile] = cells;
  }

  [[nodiscard]] int at(std::size_t x, std::size_t y) const {
    const Tile& tile = tiles_[y / kTileSide * geometry::kTilesPerSide + x / kTileSide];
    return index_of(tile[y % kTileSide * kTileSide + x % kTileSide]);
  }
  [[nodiscard]] int highest(std::size_t x, std::size_t y, std::size_t side) const {
    int highest = -127;
    for (std::size_t i = 0; i < side * side; ++i) {
      highest = std::max(highest, at(x * side + i % side, y * side + i / side));
    }
    return highest;
  }
  [[nodiscard]] int fine(std::size_t x, std::size_t y) const {
    const std::size_t tile = y / kTileSide * CoarseLevels::kFineTilesPerSide + x / kTileSide;
    return index_of(levels_.fine(tile)[y % kTileSide * kTileSide + x % kTileSide]);
  }
  [[nodiscard]] int rough(std::size_t x, std::size_t y) const {
    Tile tile{};
    levels_.copy_rough(tile);
    return index_of(tile[y * kTileSide + x]);
  }

  static Tile filled(int value) {
    Tile tile;
    tile.fill(static_cast<std::byte>(value));
    return tile;
  }

  CoarseLevels levels_;
  std::vector<Tile> tiles_ = std::vector<Tile>(geometry::kTileCount);
};

TEST_F(CoarseLevelsOf, AnyGridAreTheHighestIndexesBelow) {
  tests::Random random(5);
  for (int count = 0; count < 40; ++count) {
    Tile cells;
    const int highest = random.between(-20, 20);
    for (std::byte& cell : cells) {
      cell = static_cast<std::byte>(random.between(-127, highest));
    }
    take(random.below(geometry::kTilesPerSide), random.below(geometry::kTilesPerSide), cells);
  }
  for (std::size_t i = 0; i < kFineSide * kFineSide; ++i) {
    const std::size_t x = i % kFineSide;
    const std::size_t y = i / kFineSide;
    ASSERT_EQ(fine(x, y), highest(x, y, kFineCell)) << x << " " << y;
  }
  Tile rough{};
  levels_.copy_rough(rough);
  for (std::size_t i = 0; i < rough.size(); ++i) {
    ASSERT_EQ(index_of(rough[i]), highest(i % kTileSide, i / kTileSide, kRoughCell)) << i;
  }
}

TEST_F(CoarseLevelsOf, OneOccupiedCellAreOccupiedThere) {
  Tile cells = filled(-127);
  cells[kTileSide * 31 + 7] = std::byte{2};
  take(3, 5, cells);
  EXPECT_EQ(fine((3 * kTileSide + 7) / kFineCell, (5 * kTileSide + 31) / kFineCell), 2);
  EXPECT_EQ(rough((3 * kTileSide + 7) / kRoughCell, (5 * kTileSide + 31) / kRoughCell), 2);
}

TEST_F(CoarseLevelsOf, OneUnknownCellAreNotFree) {
  Tile cells = filled(-127);
  cells[0] = std::byte{0};
  take(0, 0, cells);
  EXPECT_EQ(fine(0, 0), 0);
  EXPECT_EQ(fine(1, 0), -127);
  EXPECT_EQ(rough(0, 0), 0);
}

TEST_F(CoarseLevelsOf, NothingAreUnknown) {
  EXPECT_FALSE(levels_.is_rough_known());
  take(geometry::kTilesPerSide - 1, 0, filled(-1));
  EXPECT_TRUE(levels_.is_rough_known());
  EXPECT_TRUE(levels_.is_fine_known(CoarseLevels::kFineTilesPerSide - 1));
  EXPECT_FALSE(levels_.is_fine_known(0));
  levels_.clear();
  EXPECT_FALSE(levels_.is_rough_known());
  EXPECT_EQ(fine(kFineSide - 1, 0), 0);
}

// The thesis's quadtree counts levels from the cells up: a level doubles the side.
TEST_F(CoarseLevelsOf, TheReferenceGridAreLevels3And5) {
  if constexpr (geometry::kTilesPerSide == 32) {
    EXPECT_EQ(CoarseLevels::kFineLevel, 3u);
    EXPECT_EQ(CoarseLevels::kRoughLevel, 5u);
  }
}

}  // namespace
}  // namespace iog::serial
