// A tile's masks, against loops over cells and edges.
#include "map/tile_drawing.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "map/flat_map.hpp"

namespace iog::map {
namespace {

constexpr std::uint32_t kPlenty = 1'000'000;

TileMask drawn(const WrittenBlock& map, const TilePlace& place, std::int32_t radius) {
  TileDrawing drawing(map.block(), place, radius);
  std::uint32_t budget = kPlenty;
  EXPECT_TRUE(drawing.go_on(budget));
  return drawing.mask();
}

// A polygon around a place, of so many centimetres, and sometimes with a hole.
tests::ReferenceFeature feature(tests::Random& random, PointCm around, std::int32_t size_cm) {
  tests::ReferenceFeature feature{.kind = random.one_in(2) ? Kind::kBuilding : Kind::kRoad,
                                  .rings = {}};
  for (std::size_t rings = 1 + random.below(3); rings > 0; --rings) {
    tests::ReferenceRing ring;
    for (std::size_t i = 0; i < 3 + random.below(5); ++i) {
      ring.push_back({around.x + random.between(-size_cm, size_cm),
                      around.y + random.between(-size_cm, size_cm)});
    }
    feature.rings.push_back(ring);
  }
  return feature;
}

// Features near a tile, at a place of the plane at which it is.
struct Scene {
  pose::Pose frame;
  window::TileNumber tile;
  tests::ReferenceBlock map;

  explicit Scene(tests::Random& random)
      : frame{random.between(-200'000, 200'000), random.between(-200'000, 200'000),
              static_cast<std::uint32_t>(random.next())},
        tile{random.between(-50, 50), random.between(-50, 50)} {
    const BoxCm box = TilePlace(frame, tile).box(0);
    const PointCm middle{(box.low.x + box.high.x) / 2, (box.low.y + box.high.y) / 2};
    map.extent = tests::box_around(middle, 30'000);
    if (random.one_in(3)) {  // its border crosses the tile
      map.extent.low = {middle.x + random.between(-300, 300), middle.y + random.between(-300, 300)};
    }
    for (std::size_t count = random.below(5); count > 0; --count) {
      const std::int32_t size = std::array{200, 600, 3'000, 9'000}[random.below(4)];
      const PointCm around{middle.x + random.between(-400, 400) + random.between(-size, size) / 2,
                           middle.y + random.between(-400, 400) + random.between(-size, size) / 2};
      map.features.push_back(feature(random, around, size));
      for (tests::ReferenceRing& ring : map.features.back().rings) {
        for (PointCm& point : ring) {
          point = {std::clamp(point.x, map.extent.low.x, map.extent.high.x),
                   std::clamp(point.y, map.extent.low.y, map.extent.high.y)};
        }
      }
    }
  }
};

TEST(TileDrawing, IsWhatLoopsOverCellsAndEdgesMakeOfIt) {
  tests::Random random(1);
  std::array<int, 8> cells{};
  for (int i = 0; i < tests::effort(600, 40); ++i) {
    const Scene scene(random);
    const WrittenBlock map(scene.map);
    ASSERT_EQ(check(map.bytes()), Refusal::kNone);
    const TilePlace place(scene.frame, scene.tile);
    const std::int32_t radius = random.between(0, kHalo);
    const TileClasses classes = classes_of(drawn(map, place, radius));
    ASSERT_EQ(classes, expected(scene.map, place, radius)) << i;
    for (const auto& row : classes) {
      for (const std::uint8_t cell : row) {
        ++cells[cell];
      }
    }
  }
  for (std::size_t mask = 1; mask < cells.size(); ++mask) {
    EXPECT_GT(cells[mask], 0) << mask;
  }
  EXPECT_EQ(cells[0], 0);
}

// The same with whatever budgets. What is left of a budget buys an edge, whatever that costs.
TEST(TileDrawing, CanBeLeftAndGoneOnWith) {
  tests::Random random(2);
  for (int i = 0; i < tests::effort(200, 10); ++i) {
    const Scene scene(random);
    const WrittenBlock map(scene.map);
    const TilePlace place(scene.frame, scene.tile);
    TileDrawing whole(map.block(), place, 5);
    std::uint32_t budget = kPlenty;
    ASSERT_TRUE(whole.go_on(budget));
    const std::uint32_t work = kPlenty - budget;
    TileDrawing parts(map.block(), place, 5);
    std::uint32_t taken = 0;
    for (bool is_whole = false; !is_whole;) {
      const auto part = static_cast<std::uint32_t>(1 + random.below(7));
      budget = part;
      is_whole = parts.go_on(budget);
      taken += part - budget;
      ASSERT_LE(taken, work);
      ASSERT_TRUE(is_whole || budget == 0);
    }
    ASSERT_GE(taken * kWorkPerCrossing, work);
    ASSERT_EQ(parts.mask(), whole.mask());
  }
}

// Far from all edges a cell is what a map in metres says: no rounding can matter there.
TEST(TileDrawing, AHouseIsWhereItIsInThePlane) {
  tests::Random random(3);
  for (int i = 0; i < tests::effort(200, 10); ++i) {
    const pose::Pose frame{random.between(-90'000, 90'000), random.between(-90'000, 90'000),
                           static_cast<std::uint32_t>(random.next())};
    const double angle = frame.heading * (2 * std::numbers::pi / 4294967296.0);
    const BoxCm house{{-400, -300}, {500, 600}};
    const WrittenBlock map({.features = {{Kind::kBuilding, {tests::rectangle(house)}}}});
    const double x = -frame.x_mm / 1000.0;  // the plane's origin, in the local frame
    const double y = -frame.y_mm / 1000.0;
    const double cell = geometry::kCellMm / 1000.0;
    const window::TileNumber tile{static_cast<std::int32_t>(std::floor(
                                      (std::cos(angle) * x + std::sin(angle) * y) / cell / 32)),
                                  static_cast<std::int32_t>(std::floor(
                                      (std::cos(angle) * y - std::sin(angle) * x) / cell / 32))};
    const TileClasses classes = classes_of(drawn(map, TilePlace(frame, tile), 0));
    for (std::int32_t at = 0; at < 1024; ++at) {
      const double local_x = (tile.a * 32 + at % 32 + 0.5) * cell;
      const double local_y = (tile.b * 32 + at / 32 + 0.5) * cell;
      const double east =
          100 * (frame.x_mm / 1000.0 + std::cos(angle) * local_x - std::sin(angle) * local_y);
      const double north =
          100 * (frame.y_mm / 1000.0 + std::sin(angle) * local_x + std::cos(angle) * local_y);
      const double inside = std::min(std::min(east - house.low.x, house.high.x - east),
                                     std::min(north - house.low.y, house.high.y - north));
      if (std::abs(inside) > 0.1) {
        ASSERT_EQ(classes[static_cast<std::size_t>(at / 32)][static_cast<std::size_t>(at % 32)],
                  inside > 0 ? decision::kBuilding : decision::kIntermediate);
      }
    }
  }
}

// Kurdej 2015, section 4.6: a border is one of both sides.
TEST(TileDrawing, ABorderIsTheUnion) {
  const std::int32_t cell = geometry::kCellMm / 10;
  const WrittenBlock map(
      {.extent = tests::box_around({0, 0}, 9'000),
       .features = {{Kind::kBuilding, {tests::rectangle({{0, -900}, {9'000, 900}})}},
                    {Kind::kRoad, {tests::rectangle({{-9'000, -900}, {-8 * cell, 900}})}}}});
  const TilePlace place({16 * -10 * cell, 0, 0}, {0, 0});  // the plane's x = 0 is column 16
  const TileClasses classes = classes_of(drawn(map, place, 4));
  const std::array<std::uint8_t, 32> row{2, 2, 2, 2, 6, 6, 6, 6, 6, 6, 6, 6, 5, 5, 5, 5,
                                         5, 5, 5, 5, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1};
  EXPECT_EQ(classes[10], row);
}

TEST(TileDrawing, ATileIsOutsideIfNothingNearIsInTheExtent) {
  const WrittenBlock map({.extent = tests::box_around({0, 0}, 100)});
  const std::int32_t tile_mm = 32 * geometry::kCellMm;
  const auto is_outside = [&](std::int32_t x_mm, std::int32_t radius) {
    return TileDrawing::is_outside(map.block(), TilePlace({x_mm, 0, 0}, {0, 0}), radius);
  };
  EXPECT_FALSE(is_outside(1'000, 0));
  EXPECT_FALSE(is_outside(-1'000 - tile_mm, 0));
  EXPECT_TRUE(is_outside(1'100, 0));
  EXPECT_TRUE(is_outside(-1'100 - tile_mm, 0));
  EXPECT_FALSE(is_outside(1'100, 1));
}

TEST(RuleOut, IsWhatIsNotPossible) {
  tests::Random random(4);
  TileMask mask;
  for (std::size_t y = 0; y < mask.road.size(); ++y) {
    mask.building[y] = static_cast<std::uint32_t>(random.next());
    mask.road[y] = static_cast<std::uint32_t>(random.next());
    mask.intermediate[y] = ~(mask.building[y] & mask.road[y]);
  }
  window::TileRuledOut ruled_out{};
  rule_out(mask, ruled_out);
  EXPECT_EQ(classes_of(ruled_out), classes_of(mask));
}

}  // namespace
}  // namespace iog::map
