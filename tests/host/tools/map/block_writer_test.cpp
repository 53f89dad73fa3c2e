// Polygons to a block and back.
#include "tools/map/block_writer.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include "gtest/gtest.h"

#include "fakes/reference_block.hpp"
#include "map_sample.hpp"
#include "tools/info/file_summary.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

using map::BoxCm;
using map::PointCm;
using Fate = BlockWriter::Fate;

constexpr BoxCm kExtent{{-5'000, -4'000}, {5'000, 4'000}};

BlockInfo info() {
  return {.latitude = 49'012'345'678,
          .longitude = -8'765'432'109,
          .extent = kExtent,
          .source = map::Source::kOpenStreetMap,
          .belief = 248,
          .date_s = 1'700'000'000,
          .accuracy_mm = 500,
          .attribution = "A town"};
}

std::vector<std::uint8_t> block_of(const std::vector<Polygon>& polygons) {
  BlockWriter writer(info());
  for (const Polygon& polygon : polygons) {
    EXPECT_EQ(writer.add(polygon), Fate::kTaken);
  }
  return writer.block();
}

bool is_inside(double x, double y, const std::vector<Ring>& rings) {
  bool inside = false;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const PlanePoint& from = ring[i];
      const PlanePoint& to = ring[(i + 1) % ring.size()];
      if ((from.y <= y) != (to.y <= y) &&
          x < from.x + (y - from.y) / (to.y - from.y) * (to.x - from.x)) {
        inside = !inside;
      }
    }
  }
  return inside;
}

bool is_inside(double x, double y, const map::Feature& feature) {
  std::vector<Ring> edges;
  feature.for_each_edge([&](PointCm from, PointCm to) {
    edges.push_back({{static_cast<double>(from.x), static_cast<double>(from.y)},
                     {static_cast<double>(to.x), static_cast<double>(to.y)}});
  });
  bool inside = false;
  for (const Ring& edge : edges) {
    if ((edge[0].y <= y) != (edge[1].y <= y) &&
        x < edge[0].x + (y - edge[0].y) / (edge[1].y - edge[0].y) * (edge[1].x - edge[0].x)) {
      inside = !inside;
    }
  }
  return inside;
}

double distance_to_outline(double x, double y, const std::vector<Ring>& rings) {
  double least = 1e9;
  for (const Ring& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const PlanePoint& a = ring[i];
      const PlanePoint& b = ring[(i + 1) % ring.size()];
      const double dx = b.x - a.x;
      const double dy = b.y - a.y;
      const double share =
          std::clamp(((x - a.x) * dx + (y - a.y) * dy) / (dx * dx + dy * dy + 1e-9), 0.0, 1.0);
      least = std::min(least, std::hypot(x - a.x - share * dx, y - a.y - share * dy));
    }
  }
  return least;
}

// The bytes of docs/spec.md, by an independent writer.
TEST(BlockWriter, WritesWhatTheSpecificationSays) {
  tests::ReferenceBlock reference;
  reference.features = {
      {map::Kind::kBuilding,
       {{{-3'000, 0}, {-2'000, 0}, {-2'000, 900}}, {{-2'900, 1}, {-2'100, 1}, {-2'100, 90}}}},
      {map::Kind::kRoad, {{{4'000, 3'000}, {5'000, 3'000}, {4'500, 4'000}}}}};
  const auto bytes = block_of(
      {{map::Kind::kRoad, {{{4'000, 3'000}, {5'000, 3'000}, {4'500, 4'000}}}},
       {map::Kind::kBuilding,
        {{{-3'000, 0}, {-2'000, 0}, {-2'000, 900}}, {{-2'900, 1}, {-2'100, 1}, {-2'100, 90}}}}});
  EXPECT_EQ(bytes, reference.bytes());
}

// Within the extent a place is in the block's feature if it was in the polygon, but for the
// centimetre of the rounding.
TEST(BlockWriter, CutsPolygonsAtTheExtent) {
  std::mt19937 random(5);
  const auto coordinate = [&] { return static_cast<double>(random() % 160'000) / 10 - 8'000; };
  int taken = 0;
  for (int i = 0; i < 200; ++i) {
    std::vector<Ring> rings(1 + random() % 2);
    for (Ring& ring : rings) {
      for (std::size_t k = 3 + random() % 6; k > 0; --k) {
        ring.push_back({coordinate(), coordinate()});
      }
    }
    BlockWriter writer(info());
    const Fate fate = writer.add({map::Kind::kRoad, rings});
    taken += fate == Fate::kTaken ? 1 : 0;
    const auto bytes = writer.block();
    ASSERT_EQ(map::check(bytes), map::Refusal::kNone);
    const map::Block block(bytes);
    for (int k = 0; k < 500; ++k) {
      const double x = coordinate();
      const double y = coordinate();
      if (std::abs(x) < 5'000 && std::abs(y) < 4'000 && distance_to_outline(x, y, rings) > 1.5) {
        const bool is_in = fate == Fate::kTaken && is_inside(x, y, block.feature(0));
        ASSERT_EQ(is_in, is_inside(x, y, rings)) << i << ": " << x << ", " << y;
      }
    }
  }
  EXPECT_GT(taken, 100);
}

TEST(BlockWriter, TakesNothingThatLiesOutside) {
  BlockWriter writer(info());
  EXPECT_EQ(writer.add({map::Kind::kRoad, {{{6'000, 0}, {7'000, 0}, {7'000, 100}}}}),
            Fate::kOutside);
  // Around a corner: cut, it would be a line there and back.
  EXPECT_NE(writer.add({map::Kind::kRoad,
                        {{{5'100, -9'000},
                          {9'000, -9'000},
                          {9'000, 9'000},
                          {-9'000, 9'000},
                          {-9'000, 4'100},
                          {5'100, 4'100}}}}),
            Fate::kTaken);
  EXPECT_EQ(writer.add({map::Kind::kRoad, {{{0, 0}, {0.2, 0}, {0, 0.2}}}}), Fate::kTooSmall);
  EXPECT_EQ(map::Block(writer.block()).feature_count(), 0U);
}

TEST(BlockWriter, DividesEdgesThatAreTooLongForAStep) {
  BlockInfo wide = info();
  wide.extent = {{-200'000, -200'000}, {200'000, 200'000}};
  BlockWriter writer(wide);
  ASSERT_EQ(writer.add({map::Kind::kBuilding,
                        {{{-150'000, -100'001}, {150'000, 99'998}, {-150'000, 99'998}}}}),
            Fate::kTaken);
  const auto bytes = writer.block();
  ASSERT_EQ(map::check(bytes), map::Refusal::kNone);
  const map::Feature feature = map::Block(bytes).feature(0);
  EXPECT_GT(feature.edge_count(), 20U);
  feature.for_each_edge([](PointCm from, PointCm to) {
    EXPECT_LE(std::abs(to.x - from.x), 32'767);
    EXPECT_LE(std::abs(to.y - from.y), 32'767);
    // On one of the three lines, to the rounding.
    const double off = std::abs(from.y + 100'001 - (from.x + 150'000) * 199'999.0 / 300'000);
    EXPECT_TRUE(off < 1 || from.x == -150'000 || from.y == 99'998);
  });
}

TEST(BlockWriter, RefusesAFeatureOfTooManyVertices) {
  Ring comb;
  for (int i = 0; i < 65'536; ++i) {
    comb.push_back({static_cast<double>(i % 4'000), static_cast<double>(i % 4'001)});
  }
  BlockWriter writer(info());
  EXPECT_EQ(writer.add({map::Kind::kBuilding, {comb}}), Fate::kTooManyVertices);
}

// The extent is within the bounds of the file everywhere, not at its corners alone: on this side of
// the equator a parallel bends north of the plane's straight line.
TEST(MapMaker, StaysWithinTheBounds) {
  GeoMap geo;
  geo.attribution = "nobody";
  geo.bounds = GeoExtent(GeoBox{59.95, 9.9, 60.05, 10.1});
  geo.box = *geo.bounds;
  const MadeMap made = make_block(geo, {});
  const map::Block block(made.block);
  EXPECT_EQ(block.latitude(), 60'000'000'000);
  EXPECT_EQ(block.longitude(), 10'000'000'000);
  // By PROJ, as in place_test.cpp: 60.05, 10.1 is 5571.575 m east; 60.05, 10 is 5570.635 m north
  // and 60.05, 10.1 more; 59.95, 10.1 is -5566.369 m north and 59.95, 10 less.
  EXPECT_NEAR(block.extent().high.x, 557'157, 2);
  EXPECT_NEAR(block.extent().low.x, -557'157, 2);
  EXPECT_NEAR(block.extent().high.y, 557'063, 2);
  EXPECT_NEAR(block.extent().low.y, -556'636, 2);
}

TEST(MapMaker, TakesTheExtentThatIsAskedForAndTheDataHave) {
  tests::OsmText osm;
  osm.way(osm.square(-50, -50, 100), "building=yes");
  const tests::TemporaryFolder folder;
  GeoMap geo = read_osm(tests::write_text(folder / "map.osm", osm.text()));
  const tests::Covered small(geo, {.origin = MapOrigin{}, .radius_m = 20});
  EXPECT_EQ(small.block().extent(), (BoxCm{{-2'000, -2'000}, {2'000, 2'000}}));
  EXPECT_EQ(small.at(19, 19), 1);
  EXPECT_EQ(small.at(21, 0), 0) << "cut";
  const MadeMap large = make_block(geo, {.origin = MapOrigin{}, .radius_m = 2'000});
  EXPECT_NE(large.remark, "");
  EXPECT_NEAR(map::Block(large.block).extent().high.x, 22'264, 1) << "0.002 degrees";
  EXPECT_THROW(static_cast<void>(make_block(geo, {.origin = MapOrigin{1'000'000'000, 0}})),
               UsageError);
  EXPECT_THROW(static_cast<void>(make_block(geo, {.origin = MapOrigin{60'000'000'000, 0}})),
               UsageError);
  GeoMap nothing;
  EXPECT_THROW(static_cast<void>(make_block(nothing, {})), UsageError);
}

TEST(MapMaker, IsTheSameEveryTime) {
  tests::OsmText osm;
  for (int i = 0; i < 20; ++i) {
    osm.way(osm.square(i * 9 - 100, i * 7 - 100, 6), "building=yes");
  }
  EXPECT_EQ(tests::Covered(osm.read()).bytes(), tests::Covered(osm.read()).bytes());
}

// The blur is the map's accuracy and 1.4 cells, up to 16 cells of 100, 200 or 500 mm.
TEST(BlockSummary, SaysWhichTargetsUseNoMapSoInexact) {
  const auto told = [](std::uint32_t accuracy_mm) {
    BlockInfo its = info();
    its.accuracy_mm = accuracy_mm;
    BlockWriter writer(its);
    EXPECT_EQ(writer.add({map::Kind::kRoad, {{{4'000, 3'000}, {5'000, 3'000}, {4'500, 4'000}}}}),
              Fate::kTaken);
    const std::string text = summary_of_block(writer.block());
    const std::size_t at = text.find("INEXACT?");
    return at == std::string::npos ? "" : text.substr(at, text.find('\n', at) - at);
  };
  EXPECT_EQ(told(1'460), "");
  EXPECT_TRUE(told(1'461).ends_with(" cells of 200 mm or more accept this accuracy"));
  EXPECT_TRUE(told(2'920).ends_with(" cells of 200 mm or more accept this accuracy"));
  EXPECT_TRUE(told(7'300).ends_with(" cells of 500 mm or more accept this accuracy"));
  EXPECT_TRUE(
      told(7'301).ends_with("no target accepts this accuracy: it blurs the map by more "
                            "than 16 cells"));
}

TEST(BlockSummary, SaysWhatABlockIsAndWhatIsWrong) {
  auto bytes = block_of({{map::Kind::kRoad, {{{4'000, 3'000}, {5'000, 3'000}, {4'500, 4'000}}}}});
  const std::string text = summary_of_block(bytes);
  for (const char* const word :
       {"sound", "A town", "1 of roads", "500 mm", "2023-11-14", "49.012345678, -8.765432109"}) {
    EXPECT_NE(text.find(word), std::string::npos) << word << " in\n" << text;
  }
  const tests::TemporaryFolder folder;
  bytes[70] ^= 1;
  tests::write_text(folder / "a", std::string(bytes.begin(), bytes.end()));
  EXPECT_NE(summary_of_file(folder / "a").find("damaged"), std::string::npos);
  EXPECT_THROW(demand_accepted_block(folder / "a"), CheckFailed);
  bytes[70] ^= 1;
  tests::write_text(folder / "a", std::string(bytes.begin(), bytes.end()));
  EXPECT_NO_THROW(demand_accepted_block(folder / "a"));
  tests::write_text(folder / "b", "no map");
  EXPECT_NO_THROW(demand_accepted_block(folder / "b"));
}

}  // namespace
}  // namespace iog::tools
