// Where a map may be: across 180 degrees, up to 80 degrees of latitude, and where there is
// something.
#include <cmath>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "map_sample.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

constexpr std::int64_t kDegree = 1'000'000'000;

// Squares of 20 m, whose corners of lowest latitude and longitude are at these places.
std::string squares_at(const std::vector<GeoPoint>& places, const std::string& bounds) {
  std::string nodes;
  std::string ways;
  int id = 0;
  for (const GeoPoint& place : places) {
    const double high = 20 * tests::kDegreesAMetreNorth;
    const double wide = high / std::cos(place.latitude * std::acos(-1.0) / 180);
    std::string refs;
    const int first = id + 1;
    for (const auto& [north, east] : {std::pair{0, 0}, {0, 1}, {1, 1}, {1, 0}}) {
      nodes += "<node id='" + std::to_string(++id) + "' version='1' lat='" +
               std::to_string(place.latitude + north * high) + "' lon='" +
               std::to_string(place.longitude + east * wide) + "'/>\n";
      refs += "<nd ref='" + std::to_string(id) + "'/>";
    }
    refs += "<nd ref='" + std::to_string(first) + "'/>";
    ways += "<way id='" + std::to_string(++id) + "' version='1'>" + refs +
            "<tag k='building' v='yes'/></way>\n";
  }
  return "<osm version='0.6'>\n" + bounds + nodes + ways + "</osm>\n";
}

GeoMap town_at(const std::vector<GeoPoint>& places, const std::string& bounds = "") {
  const tests::TemporaryFolder folder;
  return read_osm(tests::write_text(folder / "town.osm", squares_at(places, bounds)));
}

std::string refusal_of(GeoMap map, const MapOptions& options) {
  try {
    demand_features(map, make_block(map, options));
  } catch (const UsageError& error) {
    return error.what();
  }
  return {};
}

// A house 30 m west of 180 degrees, one as far east of it.
const std::vector<GeoPoint> kOnBothSides{{-16.8, 179.99953}, {-16.8, -179.99972}};

void expect_both_houses(const MadeMap& made) {
  const map::Block block(made.block);
  EXPECT_EQ(block.feature_count(), 2U);
  // Both are within 100 m of each other, and so is the extent's width.
  EXPECT_LT(block.extent().high.x - block.extent().low.x, 20'100) << made.remark;
}

TEST(MapExtent, ATownOnBothSidesOf180DegreesIsOneTown) {
  GeoMap all = town_at(kOnBothSides);
  expect_both_houses(make_block(all, {}));
  const MapOrigin middle = middle_of(all);
  EXPECT_NEAR(std::abs(static_cast<double>(middle.longitude)), 180.0 * kDegree, 1e-3 * kDegree);
  EXPECT_LE(std::abs(middle.longitude), 180 * kDegree);
  // Whatever side the origin is on, and with bounds in two parts, as files have them there.
  for (const std::int64_t longitude : {180 * kDegree, -180 * kDegree, -179'999'900'000}) {
    GeoMap some = town_at(kOnBothSides,
                          "<bounds minlat='-16.9' minlon='179.9' maxlat='-16.7' maxlon='180'/>\n");
    some.bounds->extend({-16.9, -180});
    some.bounds->extend({-16.7, -179.9});
    const MapOptions options{.origin = MapOrigin{-16'800'000'000, longitude}, .radius_m = 100};
    expect_both_houses(make_block(some, options));
  }
  GeoMap boxed = town_at(kOnBothSides);
  expect_both_houses(make_block(boxed, {.box = GeoBox{-16.801, 179.9993, -16.799, 180.0007}}));
}

// A country is larger than a plane; what is asked for is not.
TEST(MapExtent, WhatIsFarAwayDoesNotRefuseWhatIsAskedFor) {
  const GeoMap country = town_at({{48.4, 15.6}, {48.4, 9.6}, {41.0, 15.6}});
  EXPECT_NE(refusal_of(country, {}), "");
  EXPECT_EQ(
      refusal_of(country, {.origin = MapOrigin{48'400'000'000, 15'600'000'000}, .radius_m = 500}),
      "");
}

TEST(MapExtent, NothingInTheExtentIsNoMap) {
  const std::string bounds = "<bounds minlat='48' minlon='15' maxlat='49' maxlon='16'/>\n";
  const GeoMap town = town_at({{48.4, 15.6}}, bounds);
  const std::string beside =
      refusal_of(town, {.origin = MapOrigin{48'800'000'000, 15'600'000'000}, .radius_m = 500});
  EXPECT_NE(beside.find("nothing of the file"), std::string::npos) << beside;
  EXPECT_NE(beside.find("1 are outside"), std::string::npos) << beside;
  const std::string elsewhere =
      refusal_of(town, {.origin = MapOrigin{-33 * kDegree, 151 * kDegree}, .radius_m = 500});
  EXPECT_NE(elsewhere.find("nothing in common"), std::string::npos) << elsewhere;
}

// docs/map.md: within 80 degrees of latitude, near a pole east is everywhere.
TEST(MapExtent, APlaneTouchesTheEarthWithin80Degrees) {
  EXPECT_EQ(refusal_of(town_at({{79.9, 15.6}}), {}), "");
  for (const double latitude : {80.5, -80.5}) {
    const std::string words = refusal_of(town_at({{latitude, 15.6}}), {});
    EXPECT_NE(words.find("within 80 degrees"), std::string::npos) << words;
  }
}

}  // namespace
}  // namespace iog::tools
