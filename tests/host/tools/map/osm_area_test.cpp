// What becomes of buildings and other areas of OpenStreetMap. The rules are those of docs/map.md.
#include <string>

#include "gtest/gtest.h"

#include "map_sample.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

using tests::Covered;
using tests::OsmText;
using Column = Census::Column;

constexpr int kBuilding = 1;
constexpr int kRoad = 2;

// What a square of 10 m, whose lower left corner is the origin, becomes by its tags.
Covered square_with(const std::string& tags) {
  OsmText osm;
  osm.way(osm.square(0, 0, 10), tags);
  return Covered(osm.read());
}

TEST(OsmBuilding, IsWhereItsOutlineIs) {
  const Covered map = square_with("building=yes");
  EXPECT_EQ(map::check(map.bytes()), map::Refusal::kNone);
  EXPECT_EQ(map.at(5, 5), kBuilding);
  EXPECT_EQ(map.at(0.1, 9.9), kBuilding);
  EXPECT_EQ(map.at(-0.1, 5), 0);
  EXPECT_EQ(map.at(5, 10.1), 0);
  EXPECT_EQ(map.census().of(Column::kTaken, "buildings"), 1U);
  EXPECT_EQ(map.block().source(), map::Source::kOpenStreetMap);
  EXPECT_EQ(map.block().belief(), 248);
  EXPECT_EQ(map.block().attribution(), "\u00A9 OpenStreetMap contributors, ODbL 1.0");
}

TEST(OsmBuilding, CountsOnlyWhereItStandsOnTheGround) {
  for (const std::string tags : {"building=house", "building=construction", "building=yes;layer=1",
                                 "building=yes;min_level=0"}) {
    EXPECT_EQ(square_with(tags).at(5, 5), kBuilding) << tags;
  }
  struct Case {
    std::string tags;
    std::string reason;
  };
  for (const Case& no :
       {Case{"building=roof", "roof without walls"}, Case{"building=carport", "roof without walls"},
        Case{"building=yes;wall=no", "roof without walls"},
        Case{"building=no", "building that is not there"},
        Case{"building=proposed", "building that is not there"},
        Case{"building=yes;min_level=1", "building above the ground"},
        Case{"building=yes;min_height=2.5 m", "building above the ground"},
        Case{"building=yes;building:min_level=2", "building above the ground"},
        Case{"building=yes;location=underground", "building below ground or indoors"},
        Case{"building=yes;layer=-1", "building below ground or indoors"},
        Case{"building:part=yes", "part of a building, whose outline counts"}}) {
    const Covered map = square_with(no.tags);
    EXPECT_EQ(map.at(5, 5), 0) << no.tags;
    EXPECT_EQ(map.census().of(Column::kRefused, no.reason), 1U) << no.tags;
    EXPECT_EQ(map.census().sum(Column::kTaken), 0U) << no.tags;
  }
  EXPECT_EQ(square_with("landuse=farmyard").census().sum(Column::kRefused), 0U) << "says nothing";
}

TEST(OsmRoadArea, IsARoad) {
  EXPECT_EQ(square_with("highway=service;area=yes").at(5, 5), kRoad);
  EXPECT_EQ(square_with("area:highway=residential").at(5, 5), kRoad);
  EXPECT_EQ(square_with("highway=pedestrian;area=yes").at(5, 5), 0);
  EXPECT_EQ(square_with("area:highway=footway").at(5, 5), 0);
  EXPECT_EQ(square_with("amenity=parking").at(5, 5), 0);
}

TEST(OsmMultipolygon, HasHolesAndSeveralOutlines) {
  OsmText osm;
  const auto outer = osm.way(osm.square(0, 0, 30), "");
  const auto court = osm.way(osm.square(10, 10, 10), "");
  const auto in_court = osm.way(osm.square(14, 14, 2), "");
  const auto wing = osm.way(osm.square(40, 0, 10), "");
  osm.multipolygon({outer, court, in_court, wing}, "building=yes");
  const Covered map(osm.read());
  EXPECT_EQ(map.at(5, 5), kBuilding);
  EXPECT_EQ(map.at(12, 12), 0);
  EXPECT_EQ(map.at(15, 15), kBuilding);
  EXPECT_EQ(map.at(45, 5), kBuilding);
  EXPECT_EQ(map.at(35, 5), 0);
  EXPECT_EQ(map.census().of(Column::kTaken, "buildings"), 3U) << "outlines";
}

TEST(OsmMultipolygon, IsJoinedOfWays) {
  OsmText osm;
  const auto a = osm.node(0, 0);
  const auto b = osm.node(20, 0);
  const auto c = osm.node(0, 20);
  const auto first = osm.way({a, b}, "");
  const auto second = osm.way({c, a}, "");
  const auto third = osm.way({b, c}, "");
  osm.multipolygon({first, second, third}, "building=yes");
  const Covered map(osm.read());
  EXPECT_EQ(map.at(5, 5), kBuilding);
  EXPECT_EQ(map.at(15, 15), 0);
}

TEST(OsmArea, IsRefusedWholeIfItIsBroken) {
  OsmText osm;
  const auto a = osm.node(0, 0);
  const auto b = osm.node(20, 0);
  const auto c = osm.node(20, 20);
  const auto d = osm.node(0, 20);
  osm.way({a, b, c, d}, "building=yes");              // open
  osm.way({a, c, b, d, a}, "building=yes");           // crosses itself
  osm.way({a, b, 999'999, d, a}, "building=yes");     // a node is missing
  osm.way({999'998, a, b, 999'998}, "building=yes");  // the first one
  osm.way({a, b, a}, "building=yes");                 // no area
  osm.way({}, "building=yes");
  osm.multipolygon({osm.way({a, b, c}, "")}, "building=yes");  // open
  osm.multipolygon({999'997}, "building=yes");                 // a way is missing
  osm.multipolygon({osm.way({a, b, 999'996, a}, "")}, "building=yes");
  const Covered map(osm.read());
  EXPECT_EQ(map.block().feature_count(), 0U);
  const Census& census = map.census();
  EXPECT_EQ(census.of(Column::kRefused, "area whose outline is open"), 2U) << census.table();
  EXPECT_EQ(census.of(Column::kRefused, "area whose outline crosses itself"), 1U);
  EXPECT_EQ(census.of(Column::kRefused, "area with a node that is missing"), 4U);
  EXPECT_EQ(census.of(Column::kRefused, "area of fewer than three nodes"), 1U);
  EXPECT_EQ(census.of(Column::kRefused, "multipolygon of which ways are missing"), 1U);
  EXPECT_EQ(census.sum(Column::kRefused), 9U) << census.table();
}

TEST(OsmFile, MayBeInAnyOrder) {
  const std::string text =
      "<osm version='0.6'>"
      "<way id='7' version='1'><nd ref='3'/><nd ref='2'/><nd ref='1'/><nd ref='3'/>"
      "<tag k='building' v='yes'/></way>"
      "<node id='3' version='1' lat='0' lon='0'/><node id='2' version='1' lat='0' lon='0.0002'/>"
      "<node id='1' version='1' lat='0.0002' lon='0'/></osm>";
  const tests::TemporaryFolder folder;
  const Covered map(read_osm(tests::write_text(folder / "map.osm", text)));
  EXPECT_EQ(map.at(5, 5), kBuilding);
}

TEST(OsmFile, IsRefusedWithItsNameIfItIsNone) {
  const tests::TemporaryFolder folder;
  for (const std::string text : {"", "no map", "<osm version='0.6'><node", "<html></html>"}) {
    const std::string path = tests::write_text(folder / "map.osm", text);
    try {
      static_cast<void>(read_osm(path));
      ADD_FAILURE() << text;
    } catch (const UsageError& error) {
      EXPECT_TRUE(std::string(error.what()).starts_with(path)) << error.what();
    }
  }
  EXPECT_THROW(static_cast<void>(read_osm(folder / "none.osm")), UsageError);
  EXPECT_THROW(static_cast<void>(read_osm(tests::write_text(folder / "map.txt", ""))), UsageError);
}

}  // namespace
}  // namespace iog::tools
