// Places of the map's plane among a tile's cells, against floating point.
#include "map/tile_place.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::map {
namespace {

struct Metres {
  double x = 0;
  double y = 0;
};

double angle_of(const pose::Pose& pose) {
  return pose.heading * (2 * std::numbers::pi / 4294967296.0);
}

Metres to_plane(const pose::Pose& frame, Metres local) {
  const double cos = std::cos(angle_of(frame));
  const double sin = std::sin(angle_of(frame));
  return {frame.x_mm / 1000.0 + cos * local.x - sin * local.y,
          frame.y_mm / 1000.0 + sin * local.x + cos * local.y};
}

Metres to_local(const pose::Pose& frame, Metres plane) {
  const double cos = std::cos(angle_of(frame));
  const double sin = std::sin(angle_of(frame));
  const Metres from{plane.x - frame.x_mm / 1000.0, plane.y - frame.y_mm / 1000.0};
  return {cos * from.x + sin * from.y, cos * from.y - sin * from.x};
}

// The sides of cells and tiles.
struct Sizes {
  std::int32_t cell_mm;
  double cell_m = cell_mm / 1000.0;
  double tile_m = cell_m * window::kTileSide;
};

Sizes some_sizes(int i) { return {std::array{100, 200, 500}.at(static_cast<std::size_t>(i) % 3)}; }

// A local frame whose origin is within so many metres of the plane's, however it is turned.
pose::Pose frame_within(tests::Random& random, std::int32_t metres) {
  return {random.between(-1000 * metres, 1000 * metres),
          random.between(-1000 * metres, 1000 * metres), static_cast<std::uint32_t>(random.next())};
}

window::TileNumber tile_at(Metres local, double tile_m) {
  return {static_cast<std::int32_t>(std::floor(local.x / tile_m)),
          static_cast<std::int32_t>(std::floor(local.y / tile_m))};
}

// Of a vertex, in fine units; the sine's table is off by 2^-21 of the way to the local frame's
// origin (numeric/rotation.hpp), coefficients by 2^-26 a centimetre.
TEST(TilePlace, VerticesAreRoundedToTheNearestFineUnit) {
  tests::Random random(1);
  double most = 0;
  for (int i = 0; i < tests::effort(20000, 500); ++i) {
    const pose::Pose frame = frame_within(random, i % 2 == 0 ? 100 : 80'000);
    const Metres local{random.between(-500, 500) * 1.0, random.between(-500, 500) * 1.0};
    const Metres plane = to_plane(frame, local);
    const PointCm vertex{static_cast<std::int32_t>(std::llround(100 * plane.x)),
                         static_cast<std::int32_t>(std::llround(100 * plane.y))};
    const auto [cell_mm, cell_m, tile_m] = some_sizes(i);
    const window::TileNumber tile = tile_at({local.x + random.between(-50, 50), local.y}, tile_m);
    const FinePoint point = TilePlace(frame, tile, cell_mm).fine(vertex);
    const Metres exact = to_local(frame, {vertex.x / 100.0, vertex.y / 100.0});
    const double error =
        std::max(std::abs(point.x - (exact.x - tile.a * tile_m) / cell_m * kFine - kHalo * kFine),
                 std::abs(point.y - (exact.y - tile.b * tile_m) / cell_m * kFine - kHalo * kFine));
    const double way_cells = std::hypot(local.x, local.y) / cell_m;
    const double way_cm = std::abs(vertex.x) + std::abs(vertex.y) + 0.0;
    ASSERT_LE(error, 0.5 + way_cells * kFine / 2'097'152 * 1.5 + way_cm / 67'108'864 + 0.01);
    most = std::max(most, error);
  }
  EXPECT_GT(most, 0.4) << "the bound is of use";
}

TEST(TilePlace, AVertexIsAtOnePlaceForAllTiles) {
  tests::Random random(2);
  for (int i = 0; i < tests::effort(5000, 100); ++i) {
    const pose::Pose frame = frame_within(random, 1000);
    const window::TileNumber tile{random.between(-500, 500), random.between(-500, 500)};
    const window::TileNumber other{tile.a + random.between(-32, 32),
                                   tile.b + random.between(-32, 32)};
    const PointCm vertex{random.between(-200'000, 200'000), random.between(-200'000, 200'000)};
    const FinePoint one = TilePlace(frame, tile).fine(vertex);
    const FinePoint two = TilePlace(frame, other).fine(vertex);
    constexpr std::int32_t kTile = window::kTileSide * kFine;
    ASSERT_EQ(one,
              (FinePoint{two.x + (other.a - tile.a) * kTile, two.y + (other.b - tile.b) * kTile}));
  }
}

TEST(TilePlace, TheBoxHoldsAllCellsAround) {
  tests::Random random(3);
  for (int i = 0; i < tests::effort(5000, 100); ++i) {
    const pose::Pose frame = frame_within(random, i % 2 == 0 ? 1000 : 1'000'000);
    const std::int32_t reach = i % 3 == 0 ? 60'000 : 300;
    const window::TileNumber tile{random.between(-reach, reach), random.between(-reach, reach)};
    const std::int32_t around = random.between(0, kHalo);
    const auto [cell_mm, cell_m, tile_m] = some_sizes(i / 3);
    const BoxCm box = TilePlace(frame, tile, cell_mm).box(around);
    for (int corner = 0; corner < 4; ++corner) {
      const Metres plane = to_plane(
          frame, {(tile.a + corner % 2) * tile_m + (corner % 2 * 2 - 1) * around * cell_m,
                  (tile.b + corner / 2) * tile_m + (corner / 2 * 2 - 1) * around * cell_m});
      ASSERT_LE(box.low.x, 100 * plane.x);
      ASSERT_LE(box.low.y, 100 * plane.y);
      ASSERT_GE(box.high.x, 100 * plane.x);
      ASSERT_GE(box.high.y, 100 * plane.y);
    }
    // Not much larger than a square that is turned by 45 degrees.
    ASSERT_LE(box.high.x - box.low.x,
              142 * (tile_m + 2 * around * cell_m) + 14 + reach * cell_mm / 100 / 500 * 3);
  }
}

TEST(HasMoved, IfACornerHasMovedByMoreThanACell) {
  tests::Random random(4);
  int moved = 0;
  for (int i = 0; i < tests::effort(20000, 500); ++i) {
    const pose::Pose from = frame_within(random, 100);
    const auto [cell_mm, cell_m, tile_m] = some_sizes(i);
    const pose::Pose to{from.x_mm + random.between(-110, 110) * cell_mm / 100,
                        from.y_mm + random.between(-110, 110) * cell_mm / 100,
                        from.heading + static_cast<std::uint32_t>(random.between(-3000, 3000))};
    const window::TileNumber tile{random.between(-3000, 3000), random.between(-3000, 3000)};
    double most = 0;
    for (int corner = 0; corner < 4; ++corner) {
      const Metres at{(tile.a + corner % 2) * tile_m, (tile.b + corner / 2) * tile_m};
      const Metres before = to_plane(from, at);
      const Metres after = to_plane(to, at);
      most = std::max(most, std::hypot(after.x - before.x, after.y - before.y));
    }
    // Sines are interpolated: 3000 ticks of the heading are known to a few per cent of themselves.
    if (std::abs(most - cell_m) > 0.12 * cell_m) {
      ASSERT_EQ(has_moved(tile, from, to, cell_mm), most > cell_m) << most;
      moved += most > cell_m ? 1 : 0;
    }
  }
  EXPECT_GT(moved, 100);
}

TEST(HasMoved, ExactlyACellIsNotMore) {
  constexpr std::int32_t kCell = geometry::kCellMm;
  for (const std::uint32_t heading : {0U, 123'456'789U, 3'000'000'000U}) {
    const pose::Pose from{1000, 2000, heading};
    EXPECT_FALSE(has_moved({5, -7}, from, from));
    EXPECT_FALSE(has_moved({5, -7}, from, {1000 + kCell, 2000, heading}));
    EXPECT_TRUE(has_moved({5, -7}, from, {1001 + kCell, 2000, heading}));
    EXPECT_FALSE(has_moved({5, -7}, from, {1000 - kCell * 3 / 5, 2000 + kCell * 4 / 5, heading}));
    EXPECT_TRUE(has_moved({5, -7}, from, {999 - kCell * 3 / 5, 2000 + kCell * 4 / 5, heading}));
  }
}

TEST(HasMoved, TransformsMayBeAsFarApartAsCanBe) {
  constexpr std::int32_t kFar = 1'000'000'000;
  constexpr std::int32_t kTiles = kFar / (geometry::kCellMm * window::kTileSide);
  for (std::uint32_t quarter = 0; quarter < 4; ++quarter) {
    const std::uint32_t heading = quarter << 30;
    EXPECT_TRUE(has_moved({kTiles, kTiles}, {kFar, kFar, 0}, {-kFar, -kFar, heading}));
    EXPECT_TRUE(has_moved({-kTiles, kTiles}, {kFar, -kFar, heading}, {-kFar, kFar, 0x80000000U}));
  }
}

// The corners of a box, wherever it lies and however the frame is turned.
TEST(TilePlace, TheBoxOfABoxIsThatOfItsCorners) {
  tests::Random random(12);
  for (int i = 0; i < tests::effort(2000, 100); ++i) {
    const auto heading =
        static_cast<std::uint32_t>(random.below(4)) * 0x40000000U +
        (random.one_in(3) ? 0U : static_cast<std::uint32_t>(random.below(0x40000000)));
    const TilePlace place(
        {random.between(-100'000, 100'000), random.between(-100'000, 100'000), heading},
        {random.between(-20, 20), random.between(-20, 20)});
    const PointCm low{random.between(-20'000, 20'000), random.between(-20'000, 20'000)};
    const PointCm high{low.x + random.between(0, 3'000), low.y + random.between(0, 3'000)};
    FinePoint least{INT32_MAX, INT32_MAX};
    FinePoint most{INT32_MIN, INT32_MIN};
    for (const PointCm& corner : {low, high, PointCm{low.x, high.y}, PointCm{high.x, low.y}}) {
      const FinePoint at = place.fine(corner);
      least = {std::min(least.x, at.x), std::min(least.y, at.y)};
      most = {std::max(most.x, at.x), std::max(most.y, at.y)};
    }
    const FineBox box = place.fine_box({low, high});
    ASSERT_EQ(box.low, least);
    ASSERT_EQ(box.high, most);
  }
}

}  // namespace
}  // namespace iog::map
