// Where the window lies: slots, corners, and when it moves.
#include "window/area.hpp"

#include <gtest/gtest.h>
#include <set>

#include "fakes/random.hpp"

namespace iog::window {
namespace {

using geometry::Cell;

constexpr std::int32_t kMetre = 1000 / geometry::kCellMm;  // cells

TEST(Area, HoldsATileAtEachSlot) {
  for (const TileNumber corner :
       {TileNumber{0, 0}, TileNumber{-1, -32}, TileNumber{-312'500, 312'469}, TileNumber{17, -5}}) {
    const Area area(corner);
    std::set<std::size_t> slots;
    for (std::int32_t b = 0; b < kTilesAcross; ++b) {
      for (std::int32_t a = 0; a < kTilesAcross; ++a) {
        const TileNumber tile{corner.a + a, corner.b + b};
        ASSERT_TRUE(area.contains(tile));
        ASSERT_EQ(area.tile_at(slot_of(tile)), tile);
        slots.insert(slot_of(tile));
      }
    }
    EXPECT_EQ(slots.size(), kSlotCount);
    for (std::int32_t i = -1; i <= kTilesAcross; ++i) {
      EXPECT_FALSE(area.contains(TileNumber{corner.a - 1, corner.b + i}));
      EXPECT_FALSE(area.contains(TileNumber{corner.a + i, corner.b + kTilesAcross}));
    }
  }
}

// A tile lies at the same slot whatever the window is: its numbers modulo 32.
TEST(Area, SlotsAreCountedRowByRow) {
  EXPECT_EQ(slot_of({0, 0}), 0U);
  EXPECT_EQ(slot_of({1, 0}), 1U);
  EXPECT_EQ(slot_of({0, 1}), 32U);
  EXPECT_EQ(slot_of({-1, -1}), 1023U);
  EXPECT_EQ(slot_of({64 + 3, -32 + 2}), 67U);
}

TEST(Area, TilesKeepTheirSlotsWhenItMoves) {
  const Area before({10, -40});
  const Area after({11, -40});
  std::int32_t changed = 0;
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    changed += before.tile_at(slot) == after.tile_at(slot) ? 0 : 1;
  }
  EXPECT_EQ(changed, kTilesAcross) << "one column";
}

// Cells are floored: -1 mm is in cell -1.
TEST(Area, ACellOfTheFrameBeginsAtItsLowerBorder) {
  EXPECT_EQ(cell_of(pose::Pose{.x_mm = 0, .y_mm = -1}), (Cell{0, -1}));
  EXPECT_EQ(cell_of(pose::Pose{.x_mm = geometry::kCellMm - 1, .y_mm = geometry::kCellMm}),
            (Cell{0, 1}));
  EXPECT_EQ(cell_of(pose::Pose{.x_mm = -1'000'000'000, .y_mm = 1'000'000'000}),
            (Cell{-1'000'000 * kMetre, 1'000'000 * kMetre}));
}

// The least distance from the vehicle to a side of the window, in cells.
std::int32_t least_margin(const Area& area, Cell vehicle) {
  const std::int32_t left = vehicle.x - area.corner().a * kTileSide;
  const std::int32_t below = vehicle.y - area.corner().b * kTileSide;
  return std::min({left, below, kCellsAcross - 1 - left, kCellsAcross - 1 - below});
}

TEST(Area, TheVehicleKeepsFifteenTilesOnEachSide) {
  tests::Random random(11);
  Cell vehicle{random.between(-10'000'000, 10'000'000), random.between(-10'000'000, 10'000'000)};
  Area area = Area::around(vehicle);
  for (int step = 0; step < 20'000; ++step) {
    vehicle.x += random.between(-20, 25);
    vehicle.y += random.between(-25, 20);
    area = area.following(vehicle);
    ASSERT_GE(least_margin(area, vehicle), 15 * kTileSide);
  }
}

// After a move the vehicle is within half a tile of the middle, so that it has another half tile to
// go before the window moves again, or back.
TEST(Area, MovesNoSoonerThanHalfATileAfterAMove) {
  for (std::int32_t first = -100; first < 100; ++first) {
    const Area area = Area::around({first, -first});
    for (std::int32_t noise = -kTileSide / 2; noise <= kTileSide / 2; ++noise) {
      ASSERT_EQ(area.following({first + noise, -first + noise / 2}).corner(), area.corner())
          << first << " " << noise;
    }
  }
}

TEST(Area, MovesAlongTheAxisOnWhichTheVehicleIsTooFar) {
  const Area area({-16, -16});  // its middle is cell (0, 0)
  EXPECT_EQ(area.following({31, -32}).corner(), (TileNumber{-16, -16}));
  EXPECT_EQ(area.following({32, -32}).corner(), (TileNumber{-15, -16}));
  EXPECT_EQ(area.following({31, -33}).corner(), (TileNumber{-16, -17}));
  EXPECT_EQ(area.following({330, 0}).corner(), (TileNumber{-6, -16}));
}

}  // namespace
}  // namespace iog::window
