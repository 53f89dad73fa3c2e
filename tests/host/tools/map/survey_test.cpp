// Polygons of GeoJSON and of Shapefiles.
#include <filesystem>
#include <shapefil.h>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "map_sample.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

using tests::Covered;
using Column = Census::Column;

// A square of 0.0002 degrees, 22 m, with a hole of half of that; x is longitude.
constexpr const char* kSquare =
    "[[[0,0],[0.0002,0],[0.0002,0.0002],[0,0.0002],[0,0]],"
    "[[0.00005,0.00005],[0.00015,0.00005],[0.00015,0.00015],[0.00005,0.00005]]]";

std::string feature(const std::string& type, const std::string& coordinates,
                    const std::string& properties = "null") {
  return R"({"type":"Feature","properties":)" + properties + R"(,"geometry":{"type":")" + type +
         R"(","coordinates":)" + coordinates + "}}";
}

std::string collection(const std::vector<std::string>& features) {
  std::string text;
  for (const std::string& one : features) {
    text += (text.empty() ? "" : ",") + one;
  }
  return R"({"type":"FeatureCollection","features":[)" + text + "]}";
}

GeoMap read_text(const std::string& text, std::optional<map::Kind> kind = map::Kind::kBuilding) {
  const tests::TemporaryFolder folder;
  GeoMap map = read_geojson(tests::write_text(folder / "map.geojson", text), kind);
  map.attribution = "a survey";
  return map;
}

TEST(GeoJson, HasHolesAndKinds) {
  const Covered map(read_text(
      collection({feature("Polygon", kSquare),
                  feature("MultiPolygon", "[[[[0.0004,0],[0.0006,0],[0.0004,0.0002],[0.0004,0]]]]",
                          R"({"kind":"road"})")})));
  EXPECT_EQ(map.at(2, 2), 1);
  EXPECT_EQ(map.at(15, 10), 0) << "the hole";
  EXPECT_EQ(map.at(46, 2), 2);
  EXPECT_EQ(map.block().source(), map::Source::kSurveyed);
  EXPECT_EQ(map.block().belief(), 253);
  EXPECT_EQ(map.block().accuracy_mm(), 100U);
  EXPECT_EQ(map.block().attribution(), "a survey");
}

TEST(GeoJson, CountsWhatItDoesNotTake) {
  const GeoMap map = read_text(
      collection({feature("Point", "[0,0]"), feature("Polygon", "[[[0,0],[1,0],[1,1],[0,1]]]"),
                  feature("Polygon", "[[[0,0],[1,0],[0,0]]]"),
                  feature("Polygon", "[[[0,0],[1,0],[1,91],[0,0]]]"),
                  feature("Polygon", R"([[[0,0],[1,0],["x",1],[0,0]]])"), feature("Polygon", "7"),
                  feature("Polygon", kSquare, R"({"kind":"lake"})"), R"({"type":"Feature"})", "3",
                  R"({"type":"Feature","geometry":null})", feature("Polygon", kSquare)}));
  EXPECT_EQ(map.areas.size(), 1U);
  const Census& census = map.census;
  EXPECT_EQ(census.of(Column::kRefused, "no polygon"), 1U) << census.table();
  EXPECT_EQ(census.of(Column::kRefused, "area whose outline is open"), 1U);
  EXPECT_EQ(census.of(Column::kRefused, "area of fewer than three nodes"), 2U);
  EXPECT_EQ(census.of(Column::kRefused, "place that is not on earth"), 1U);
  EXPECT_EQ(census.of(Column::kRefused, "place that is not two numbers"), 1U);
  EXPECT_EQ(census.of(Column::kRefused, "kind that is neither building nor road"), 1U);
  EXPECT_EQ(census.of(Column::kRefused, "feature that is not as it should be"), 2U);
  EXPECT_EQ(census.of(Column::kRefused, "feature without a place"), 1U);
  EXPECT_EQ(census.sum(Column::kRefused), 10U);
}

// A keyhole and an outline that touches itself are sound: no two sides cross.
TEST(GeoJson, NobodyKnowsTheInsideOfAnOutlineThatCrossesItself) {
  const GeoMap map = read_text(collection(
      {feature("Polygon", "[[[0,0],[1,1],[1,0],[0,1],[0,0]]]"),
       feature("Polygon",
               "[[[0,0],[9,0],[9,9],[0,9],[0,2],[1,2],[1,5],[5,5],[5,2],[1,2],[0,2],[0,0]]]"),
       feature("Polygon", "[[[0,0],[2,0],[1,1],[2,2],[0,2],[1,1],[0,0]]]"),
       feature("Polygon", "[[[0,0],[0,0],[9,0],[9,9],[0,0]]]")}));
  EXPECT_EQ(map.areas.size(), 3U);
  EXPECT_EQ(map.census.of(Column::kRefused, kCrossesItself), 1U) << map.census.table();
}

TEST(GeoJson, IsRefusedIfItIsNone) {
  for (const std::string text :
       {"", "{", "[]", "7", R"({"type":"Topology"})",
        R"({"type":"FeatureCollection","crs":"EPSG:3857","features":[]})",
        R"({"type":"FeatureCollection","crs":null,"features":[]})",
        R"({"type":"FeatureCollection","crs":{"type":"link"},"features":[]})",
        R"({"type":"FeatureCollection","crs":{"type":"name"},"features":[]})"}) {
    EXPECT_THROW(read_text(text), UsageError) << text;
  }
  EXPECT_THROW(read_text(collection({feature("Polygon", kSquare)}), std::nullopt), UsageError);
}

// GeoJSON of 2008 names its system, and has longitude first whatever the name says.
TEST(GeoJson, MayNameItsReferenceSystem) {
  const auto map_in = [](const std::string& name) {
    std::string text = collection({feature("Polygon", kSquare)});
    text.insert(1, R"("crs":{"type":"name","properties":{"name":")" + name + R"("}},)");
    return Covered(read_text(text));
  };
  for (const std::string name :
       {"urn:ogc:def:crs:OGC:1.3:CRS84", "EPSG:4326", "urn:ogc:def:crs:EPSG::4326"}) {
    EXPECT_EQ(map_in(name).at(2, 15), 1) << name;
    EXPECT_EQ(map_in(name).block().accuracy_mm(), 100U) << name;
  }
  EXPECT_THROW(map_in("EPSG:4312"), UsageError) << "MGI";
  GeoMap surveyed = read_text(collection({feature("Polygon", kSquare)}));
  surveyed.datum_error_mm = 1000;
  EXPECT_EQ(Covered(std::move(surveyed)).block().accuracy_mm(), 1100U);
}

// Writes a shapefile of one polygon for each list of rings.
void write_shapes(const std::string& path,
                  const std::vector<std::vector<std::vector<std::pair<double, double>>>>& shapes) {
  SHPInfo* const file = SHPCreate(path.c_str(), SHPT_POLYGON);
  for (const auto& rings : shapes) {
    std::vector<int> starts;
    std::vector<double> x;
    std::vector<double> y;
    for (const auto& ring : rings) {
      starts.push_back(static_cast<int>(x.size()));
      for (const auto& [longitude, latitude] : ring) {
        x.push_back(longitude);
        y.push_back(latitude);
      }
    }
    SHPObject* const shape =
        SHPCreateObject(SHPT_POLYGON, -1, static_cast<int>(starts.size()), starts.data(), nullptr,
                        static_cast<int>(x.size()), x.data(), y.data(), nullptr, nullptr);
    SHPWriteObject(file, -1, shape);
    SHPDestroyObject(shape);
  }
  SHPClose(file);
}

TEST(Shapefile, HasPolygonsWithHoles) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "houses.shp";
  write_shapes(path,
               {{{{0, 0}, {0, 0.0002}, {0.0002, 0.0002}, {0.0002, 0}, {0, 0}},
                 {{0.00005, 0.00005}, {0.00015, 0.00005}, {0.00015, 0.00015}, {0.00005, 0.00005}}},
                {{{0, 0}, {0, 1}, {1, 1}, {1, 0.5}}},
                {{{0, 0}, {1, 1}, {1, 0}, {0, 1}, {0, 0}}},
                {{{0, 0}, {0, 200}, {1, 1}, {0, 0}}}});
  GeoMap geo = read_map(path, map::Kind::kRoad);
  EXPECT_EQ(geo.census.of(Column::kRefused, "area whose outline is open"), 1U);
  EXPECT_EQ(geo.census.of(Column::kRefused, kCrossesItself), 1U);
  EXPECT_EQ(geo.census.of(Column::kRefused, "place that is not on earth"), 1U);
  geo.attribution = "a survey";
  const Covered map(std::move(geo));
  EXPECT_EQ(map.at(2, 2), 2);
  EXPECT_EQ(map.at(15, 10), 0) << "the hole";

  EXPECT_THROW(static_cast<void>(read_map(path, std::nullopt)), UsageError) << "of which kind?";
  tests::write_text(folder / "houses.prj", "PROJCS[\"ETRS89 / UTM zone 33N\"]");
  EXPECT_THROW(static_cast<void>(read_map(path, map::Kind::kRoad)), UsageError) << "not readable";
  tests::write_text(folder / "houses.prj",
                    "\xEF\xBB\xBFGEOGCS[\"WGS 84\",\n DATUM[\"WGS_1984\","
                    "SPHEROID[\"WGS 84\",6378137,298.257223563]],\n PRIMEM[\"Greenwich\",0],"
                    "UNIT[\"degree\",0.0174532925199433]]\n");
  EXPECT_EQ(read_map(path, map::Kind::kRoad).areas.size(), 1U);
  std::filesystem::remove(folder / "houses.prj");
  tests::write_text(folder / "houses.PRJ",
                    "GEOGCS[\"GCS_MGI\",DATUM[\"D_MGI\",SPHEROID["
                    "\"Bessel_1841\",6377397.155,299.1528128]],PRIMEM[\"Greenwich\",0.0],"
                    "UNIT[\"Degree\",0.0174532925199433]]");
  EXPECT_THROW(static_cast<void>(read_map(path, map::Kind::kRoad)), UsageError) << "MGI";
  tests::write_text(folder / "no.shp", "no shape");
  EXPECT_THROW(static_cast<void>(read_map(folder / "no.shp", map::Kind::kRoad)), UsageError);
}

}  // namespace
}  // namespace iog::tools
