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

constexpr Extent kRectangles[] = {{4, 4}, {5, 32}, {12, 7}, {32, 11}, {32, 32}};

// docs/spec.md 3.9: (b mod r) c + (a mod c).
TEST(Area, ARectangleHasItsTilesAtTheirNumbers) {
  for (const Extent extent : kRectangles) {
    for (const TileNumber corner : {TileNumber{0, 0}, TileNumber{-1, -32}, TileNumber{-671'089, 5},
                                    TileNumber{17, 671'057}}) {
      const Area area(corner, extent);
      const auto remainder = [](std::int32_t n, std::int32_t by) { return (n % by + by) % by; };
      std::set<std::size_t> slots;
      std::size_t next = 0;
      area.for_each_tile([&](std::size_t number, TileNumber tile) {
        ASSERT_EQ(number, next++);
        ASSERT_GE(tile.a, corner.a);
        ASSERT_LT(tile.a, corner.a + extent.columns);
        ASSERT_GE(tile.b, corner.b);
        ASSERT_LT(tile.b, corner.b + extent.rows);
        ASSERT_EQ(number, static_cast<std::size_t>(remainder(tile.b, extent.rows) * extent.columns +
                                                   remainder(tile.a, extent.columns)));
        ASSERT_TRUE(area.contains(tile));
        slots.insert(slot_of(tile));
      });
      EXPECT_EQ(next, std::size_t{extent.columns} * extent.rows);
      EXPECT_EQ(slots.size(), next);
      std::size_t inside = 0;
      for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
        inside += area.contains(area.tile_at(slot)) ? 1U : 0U;
      }
      EXPECT_EQ(inside, next);
    }
  }
}

// Of a side of n tiles, (n - 2) / 2 remain on each side of the car, and none moves before the car
// has gone half a tile.
TEST(Area, ARectangleKeepsTheVehicleNearItsMiddle) {
  tests::Random random(12);
  for (const Extent extent : kRectangles) {
    Cell vehicle{random.between(-9'999, 9'999), random.between(-9'999, 9'999)};
    Area area = Area::around(vehicle, extent);
    Cell moved_at = vehicle;
    for (int step = 0; step < 5'000; ++step) {
      vehicle.x += random.between(-20, 25);
      vehicle.y += random.between(-25, 20);
      const Area next = area.following(vehicle);
      ASSERT_EQ(next.extent(), extent);
      const std::int32_t left = 2 * (vehicle.x - next.corner().a * kTileSide);
      const std::int32_t below = 2 * (vehicle.y - next.corner().b * kTileSide);
      ASSERT_LE(std::abs(left - extent.columns * kTileSide), 2 * kTileSide);
      ASSERT_LE(std::abs(below - extent.rows * kTileSide), 2 * kTileSide);
      if (next.corner().a != area.corner().a) {
        ASSERT_GE(std::abs(vehicle.x - moved_at.x), kTileSide / 2);
        ASSERT_LE(std::abs(left - extent.columns * kTileSide), kTileSide);
        moved_at.x = vehicle.x;
      }
      area = next;
    }
  }
}

}  // namespace
}  // namespace iog::window
