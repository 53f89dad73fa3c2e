// What becomes of the roads of OpenStreetMap. The rules are those of docs/map.md.
#include <cmath>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "map_sample.hpp"

namespace iog::tools {
namespace {

using tests::Covered;
using tests::OsmText;
using Column = Census::Column;

constexpr int kRoad = 2;

// A road of 100 m to the east from the origin.
Covered road_with(const std::string& tags) {
  OsmText osm;
  const auto from = osm.node(0, 0);
  osm.way({from, osm.node(100, 0)}, tags);
  return Covered(osm.read());
}

// How wide it is in its middle, to a centimetre.
double width_of(const Covered& map) {
  int wide = 0;
  for (int cm = -4'000; cm <= 4'000; ++cm) {
    wide += map.at(50, (cm + 0.5) / 100) == kRoad ? 1 : 0;
  }
  return wide / 100.0;
}

TEST(OsmRoad, IsAsWideAsItSays) {
  struct Case {
    std::string tags;
    double width_m;
  };
  for (const Case& road :
       {Case{"highway=residential;width=5", 5}, Case{"highway=residential;width=5.5 m", 5.5},
        Case{"highway=residential;width=4,5", 4.5}, Case{"highway=residential;width=10'", 3.05},
        Case{"highway=residential;width=9'6\"", 2.90},
        Case{"highway=residential;width=20 ft", 6.10}, Case{"highway=residential;lanes=3", 9.75},
        Case{"highway=residential;lanes=3;width=8", 8}, Case{"highway=motorway", 11},
        Case{"highway=trunk", 11}, Case{"highway=primary", 9}, Case{"highway=secondary", 8},
        Case{"highway=tertiary", 7}, Case{"highway=unclassified", 7},
        Case{"highway=residential", 6.5}, Case{"highway=living_street", 6},
        Case{"highway=service", 4}}) {
    EXPECT_NEAR(width_of(road_with(road.tags)), road.width_m, 0.015) << road.tags;
  }
}

TEST(OsmRoad, HasADefaultWhereTheWidthIsNone) {
  struct Case {
    std::string tags;
    std::string remark;
    double width_m;
  };
  for (const Case& road :
       {Case{"width=narrow", "width that cannot be read", 6.5}, Case{"width=3;lanes=x", "", 3},
        Case{"width=-3", "width that cannot be read", 6.5},
        Case{"width=3..5", "width that cannot be read", 6.5},
        Case{"width=3 cm", "width that cannot be read", 6.5},
        Case{"width=0", "width that cannot be", 6.5},
        Case{"width=350", "width that cannot be", 6.5},
        Case{"width=1e400", "width that cannot be read", 6.5},
        Case{"width=?;lanes=2", "width that cannot be read", 6.5},
        Case{"lanes=many", "lanes that cannot be read", 6.5},
        Case{"lanes=0", "lanes that cannot be read", 6.5}}) {
    const Covered map = road_with("highway=residential;" + road.tags);
    EXPECT_NEAR(width_of(map), road.width_m, 0.015) << road.tags;
    EXPECT_EQ(map.census().of(Column::kDefaulted, road.remark), road.remark.empty() ? 0U : 1U)
        << road.tags;
  }
}

TEST(OsmRoad, IsOneForCarsAboveTheGround) {
  for (const std::string tags :
       {"highway=service;tunnel=building_passage", "highway=service;covered=yes",
        "highway=primary;bridge=yes;layer=1", "highway=primary;layer=-1",
        "highway=primary;tunnel=no"}) {
    EXPECT_EQ(road_with(tags).at(50, 0), kRoad) << tags;
  }
  struct Case {
    std::string tags;
    std::string reason;
  };
  for (const Case& no : {Case{"highway=footway", "way that is not for cars"},
                         Case{"highway=track", "way that is not for cars"},
                         Case{"highway=steps;width=3", "way that is not for cars"},
                         Case{"highway=construction", "road that is not there"},
                         Case{"highway=proposed", "road that is not there"},
                         Case{"highway=primary;tunnel=yes", "road in a tunnel"},
                         Case{"highway=service;indoor=yes", "road indoors or off the ground"}}) {
    const Covered map = road_with(no.tags);
    EXPECT_EQ(map.at(50, 0), 0) << no.tags;
    EXPECT_EQ(map.census().of(Column::kRefused, no.reason), 1U) << no.tags;
  }
  EXPECT_EQ(road_with("railway=rail").census().sum(Column::kRefused), 0U) << "says nothing";
}

TEST(OsmRoad, ThroughABuildingIsBoth) {
  OsmText osm;
  osm.way(osm.square(40, -10, 20), "building=yes");
  osm.way({osm.node(0, 0), osm.node(100, 0)}, "highway=service;tunnel=building_passage");
  const Covered map(osm.read());
  EXPECT_EQ(map.at(50, 0), 3);
  EXPECT_EQ(map.at(50, 5), 1);
  EXPECT_EQ(map.at(20, 0), 2);
}

// Where two ways meet at an angle, the outer corner belongs to the road; a dead end is flat.
TEST(OsmRoad, IsRoundWhereRoadsMeet) {
  OsmText osm;
  const auto joint = osm.node(50, 0);
  osm.way({osm.node(0, 0), joint}, "highway=residential;width=8");
  osm.way({joint, osm.node(50, 50)}, "highway=residential;width=8");
  const Covered map(osm.read());
  EXPECT_EQ(map.at(52, -2), kRoad);
  EXPECT_EQ(map.at(53.5, -3.5), 0) << "beyond 4 m of the joint";
  EXPECT_EQ(map.at(-0.1, 0), 0);
  EXPECT_EQ(map.at(0.1, 3.9), kRoad);
  EXPECT_EQ(map.at(50, 50.1), 0);
}

TEST(OsmRoad, OfBrokenNodesIsRefused) {
  OsmText osm;
  const auto a = osm.node(0, 0);
  osm.way({a, 999'999}, "highway=service");
  osm.way({a}, "highway=service");
  osm.way({a, a}, "highway=service");
  const Covered map(osm.read());
  EXPECT_EQ(map.block().feature_count(), 0U);
  EXPECT_EQ(map.census().of(Column::kRefused, "road with a node that is missing"), 1U);
  EXPECT_EQ(map.census().of(Column::kRefused, "road of fewer than two nodes"), 1U);
  EXPECT_EQ(map.census().of(Column::kRefused, "smaller than a centimetre"), 1U);
}

TEST(OsmRoad, RoundaboutHasAMiddle) {
  OsmText osm;
  std::vector<std::int64_t> nodes;
  nodes.reserve(25);
  for (int i = 0; i < 24; ++i) {
    nodes.push_back(osm.node(30 * std::cos(i * 0.2617994), 30 * std::sin(i * 0.2617994)));
  }
  nodes.push_back(nodes.front());
  osm.way(nodes, "highway=tertiary;junction=roundabout");
  const Covered map(osm.read());
  EXPECT_EQ(map.at(0, 0), 0);
  for (int i = 0; i < 100; ++i) {
    const double angle = i * 0.0628;
    EXPECT_EQ(map.at(29.7 * std::cos(angle), 29.7 * std::sin(angle)), kRoad) << i;
    EXPECT_EQ(map.at(25 * std::cos(angle), 25 * std::sin(angle)), 0) << i;
  }
}

}  // namespace
}  // namespace iog::tools
