// XML as editors and servers of OpenStreetMap write it: JOSM's file format, osmChange, and the
// answers of Overpass (wiki.openstreetmap.org, JOSM file format, OsmChange, Overpass QL: out).
#include <string>

#include "gtest/gtest.h"

#include "map_sample.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

using tests::Covered;
using Column = Census::Column;

constexpr int kBuilding = 1;
constexpr int kRoad = 2;

GeoMap read_objects(const std::string& objects, const std::string& root = "osm",
                    const std::string& file = "map.osm") {
  const tests::TemporaryFolder folder;
  return read_osm(tests::write_text(folder / file,
                                    "<" + root + " version='0.6'>" + objects + "</" + root + ">"));
}

// Corners of a square of 22 m whose lower left corner is east of 0, 0.
constexpr const char* kCorners[4][2] = {
    {"0", "0"}, {"0", "0.0002"}, {"0.0002", "0.0002"}, {"0.0002", "0"}};

std::string place(int corner) {
  return std::string(" lat='") + kCorners[corner][0] + "' lon='" + kCorners[corner][1] + "'";
}

std::string nodes(const std::string& of_second = "") {
  std::string text;
  for (int i = 0; i < 4; ++i) {
    text +=
        "<node id='" + std::to_string(i + 1) + "'" + place(i) + (i == 1 ? of_second : "") + "/>";
  }
  return text;
}

std::string square(const std::string& attributes = "") {
  return "<way id='7'" + attributes +
         "><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='4'/><nd ref='1'/>"
         "<tag k='building' v='yes'/></way>";
}

// As `out geom` has it.
std::string ring(bool has_numbers) {
  std::string text;
  for (const int i : {0, 1, 2, 3, 0}) {
    const std::string reference = has_numbers ? " ref='" + std::to_string(i + 1) + "'" : "";
    text += "<nd" + reference + place(i) + "/>";
  }
  return text;
}

TEST(OsmXml, LeavesOutWhatIsDeleted) {
  EXPECT_EQ(read_objects(nodes() + square()).areas.size(), 1U);
  for (const std::string how :
       {" action='delete'", " visible='false'", " version='3' visible='true' action='delete'"}) {
    EXPECT_TRUE(read_objects(nodes() + square(how)).areas.empty()) << how;
    const GeoMap without_node = read_objects(nodes(how) + square());
    EXPECT_TRUE(without_node.areas.empty()) << how;
    EXPECT_EQ(without_node.census.of(Column::kRefused, "area with a node that is missing"), 1U);
    const std::string outer =
        "<way id='7'><nd ref='1'/><nd ref='2'/><nd ref='3'/><nd ref='4'/><nd ref='1'/></way>";
    const std::string relation =
        "><member type='way' ref='7' role='outer'/><tag k='type' "
        "v='multipolygon'/><tag k='building' v='yes'/></relation>";
    EXPECT_EQ(read_objects(nodes() + outer + "<relation id='9'" + relation).areas.size(), 1U);
    EXPECT_TRUE(read_objects(nodes() + outer + "<relation id='9'" + how + relation).areas.empty());
  }
  EXPECT_EQ(read_objects(nodes(" action='modify'") + square(" action='modify' visible='true'"))
                .areas.size(),
            1U);
}

// A history has all versions, in order.
TEST(OsmXml, TakesTheLastVersionOrItsDeletion) {
  const std::string first = nodes() + square(" version='1'");
  EXPECT_TRUE(read_objects(first + "<way id='7' version='2' visible='false'/>").areas.empty());
  EXPECT_EQ(
      read_objects(nodes() + "<way id='7' version='2' visible='false'/>" + square(" version='3'"))
          .areas.size(),
      1U);
  const std::string change = "<create>" + first + "</create>";
  EXPECT_EQ(read_objects(change, "osmChange", "map.osc").areas.size(), 1U);
  EXPECT_TRUE(
      read_objects(change + "<delete><way id='7' version='2'/></delete>", "osmChange", "map.osc")
          .areas.empty());
}

TEST(OsmXml, IsRefusedIfItsServerBrokeOff) {
  for (const std::string error : {"runtime error: Query timed out in \"query\" at line 3.",
                                  "runtime error: Query run out of memory using about 2048 MB."}) {
    try {
      static_cast<void>(read_objects(nodes() + square() + "<remark> " + error + " </remark>"));
      ADD_FAILURE() << error;
    } catch (const UsageError& refused) {
      EXPECT_NE(std::string(refused.what()).find(error), std::string::npos) << refused.what();
    }
  }
  EXPECT_THROW(read_objects("<action type='delete'><old>" + nodes() + "</old></action>"),
               UsageError)
      << "an augmented diff";
}

TEST(OsmXml, KnowsWaysByTheirPlaces) {
  for (const bool has_numbers : {true, false}) {
    const std::string way =
        "<way id='7'><bounds minlat='0' minlon='0' maxlat='1' maxlon='1'/>"
        "<center lat='0' lon='0'/>" +
        ring(has_numbers) + "<tag k='building' v='yes'/></way>";
    const std::string road = "<way id='8'><nd" + place(0) + "/><nd" + place(1) +
                             "/><tag k='highway' v='service'/></way>";
    const Covered map(read_objects(way + road));
    EXPECT_EQ(map.at(10, 10), kBuilding) << has_numbers;
    EXPECT_EQ(map.at(10, 1), kBuilding + kRoad) << has_numbers;
    EXPECT_EQ(map.census().sum(Column::kRefused), 0U) << map.census().table();
  }
}

TEST(OsmXml, KnowsMultipolygonsByThePlacesOfTheirWays) {
  const auto relation = [](const std::string& of_ways) {
    return "<relation id='9'><member type='way' ref='7' role='outer'>" + of_ways +
           "</member><member type='node' ref='1' role='entrance'" + place(0) +
           "/><tag k='type' v='multipolygon'/><tag k='building' v='yes'/></relation>";
  };
  for (const bool has_numbers : {true, false}) {
    EXPECT_EQ(Covered(read_objects(relation(ring(has_numbers)))).at(10, 10), kBuilding);
  }
  EXPECT_EQ(read_objects(nodes() + square() + relation(ring(true))).areas.size(), 2U)
      << "a way of the file keeps its tags";
  // What lies outside of the box that was asked for has no place.
  const GeoMap cut = read_objects(nodes() + relation("<nd/>" + ring(false).substr(27)));
  EXPECT_TRUE(cut.areas.empty());
  EXPECT_EQ(cut.census.sum(Column::kRefused), 1U) << cut.census.table();
}

}  // namespace
}  // namespace iog::tools
