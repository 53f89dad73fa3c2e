// Coordinates of other systems. Expected places are published: by the definitions of the systems
// (EPSG's parameters), by GeographicLib's manual of GeoConvert, and by swisstopo.
#include "tools/map/reference_system.hpp"

#include "gtest/gtest.h"

#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

GeoMap map_at(double x, double y) {
  GeoMap map;
  map.areas.push_back({.rings = {{{y, x}, {y, x + 1e-4}, {y + 1e-4, x}}}, .id = "shape 0"});
  return map;
}

void expect_place(const std::string& system, double x, double y, const GeoPoint& expected,
                  std::uint32_t error_mm) {
  GeoMap map = map_at(x, y);
  to_wgs84(system, map);
  ASSERT_EQ(map.areas.size(), 1U) << system << map.census.table();
  const GeoPoint& place = map.areas[0].rings[0][0];
  EXPECT_NEAR(place.latitude, expected.latitude, 1e-5) << system;
  EXPECT_NEAR(place.longitude, expected.longitude, 1e-5) << system;
  EXPECT_NEAR(map.box.box(false).south, expected.latitude, 1e-5) << system;
  EXPECT_EQ(map.datum_error_mm, error_mm) << system;
  EXPECT_EQ(map.remark.find("added to the accuracy") != std::string::npos, error_mm > 0) << system;
}

std::string why_not(const std::string& system, double x, double y) {
  GeoMap map = map_at(x, y);
  try {
    to_wgs84(system, map);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "taken";
}

// As the .prj of an ESRI program has it.
std::string geographic(const std::string& name, const std::string& datum,
                       const std::string& ellipsoid,
                       const std::string& meridian = "\"Greenwich\",0.0",
                       const std::string& unit = "\"Degree\",0.0174532925199433") {
  return "GEOGCS[\"" + name + "\",DATUM[\"" + datum + "\",SPHEROID[" + ellipsoid + "]],PRIMEM[" +
         meridian + "],UNIT[" + unit + "]]";
}
const std::string kWgs84 = "\"WGS_1984\",6378137.0,298.257223563";
const std::string kBessel = "\"Bessel_1841\",6377397.155,299.1528128";

std::string utm38(double metres, const std::string& unit) {
  return "PROJCS[\"unit\"," + geographic("GCS_WGS_1984", "D_WGS_1984", kWgs84) +
         ",PROJECTION[\"Transverse_Mercator\"],PARAMETER[\"False_Easting\"," +
         std::to_string(500'000 / metres) +
         "],PARAMETER[\"False_Northing\",0.0],PARAMETER[\"Central_Meridian\",45.0],"
         "PARAMETER[\"Scale_Factor\",0.9996],PARAMETER[\"Latitude_Of_Origin\",0.0],UNIT[\"" +
         unit + "\"," + std::to_string(metres) + "]]";
}

TEST(ReferenceSystem, OfWgs84IsTakenAsItIs) {
  for (const std::string& system :
       {std::string(), geographic("GCS_WGS_1984", "D_WGS_1984", kWgs84), std::string("EPSG:4326"),
        std::string("urn:ogc:def:crs:EPSG::4326"), std::string("urn:ogc:def:crs:OGC:1.3:CRS84"),
        std::string("EPSG:4979")}) {
    expect_place(system, 15.6, 48.41, {48.41, 15.6}, 0);
  }
  expect_place(geographic("GCS_WGS_1984", "D_WGS_1984", kWgs84, "\"Greenwich\",0.0",
                          "\"Grad\",0.01570796326794897"),
               20, 50, {45, 18}, 0);
}

TEST(ReferenceSystem, MayBeARealisationOfTheSameFrame) {
  expect_place("EPSG:9056", 15.6, 48.41, {48.41, 15.6}, 100);   // WGS 84 (G1674)
  expect_place("EPSG:9000", 15.6, 48.41, {48.41, 15.6}, 100);   // ITRF2014
  expect_place("EPSG:8888", 15.6, 48.41, {48.41, 15.6}, 1000);  // WGS 84 (Transit)
}

TEST(ReferenceSystem, MayBeProjected) {
  // GeoConvert: 38SMB4488, the square whose middle this is, is 33.33424 44.40363.
  expect_place("EPSG:32638", 444'500, 3'688'500, {33.33424, 44.40363}, 0);
  expect_place(utm38(0.3048, "Foot"), 444'500 / 0.3048, 3'688'500 / 0.3048, {33.33424, 44.40363},
               0);
  expect_place("EPSG:3857", 0, 0, {0, 0}, 0);
}

TEST(ReferenceSystem, AddsTheErrorOfAnotherDatum) {
  expect_place("EPSG:2154", 700'000, 6'600'000, {46.5, 3}, 1000);  // Lambert-93's origin
  expect_place("EPSG:4258", 15.6, 48.41, {48.41, 15.6}, 1000);     // ETRS89
  // The old observatory of Bern, by swisstopo in WGS 84.
  expect_place("EPSG:2056", 2'600'000, 1'200'000, {46.951083, 7.438637}, 1000);
}

TEST(ReferenceSystem, IsRefusedWhereTheWayIsWorseThanAMetre) {
  const std::string mgi = geographic("GCS_MGI", "D_MGI", kBessel);
  EXPECT_NE(why_not(mgi, 15.6, 48.41).find("1.5 m"), std::string::npos)
      << why_not(mgi, 15.6, 48.41);
  EXPECT_NE(why_not("EPSG:4267", -100, 40).find(", worse than 1 m"), std::string::npos);  // NAD27
  EXPECT_NE(why_not("EPSG:4269", -100, 40).find("4 m"), std::string::npos);               // NAD83
  EXPECT_NE(why_not("EPSG:4301", 139.7, 35.7).find("9 m"), std::string::npos);            // Tokyo
  EXPECT_NE(why_not("EPSG:4230", 5, 50).find("10 m"), std::string::npos);                 // ED50
  EXPECT_NE(why_not("EPSG:31468", 4'468'000, 5'333'000).find("3 m"), std::string::npos);  // DHDN
  EXPECT_NE(why_not("EPSG:27572", 600'000, 2'200'000).find("2 m"),
            std::string::npos);  // Paris, grads
  const std::string british = why_not("EPSG:27700", 400'000, 300'000);
  EXPECT_NE(british.find("2 m"), std::string::npos) << british;
  EXPECT_NE(british.find("a grid that is not installed"), std::string::npos) << british;
}

TEST(ReferenceSystem, IsRefusedWhereNoWayIsKnown) {
  for (const std::string& system :
       {geographic("GCS_Local", "D_Local", kBessel),
        geographic("GCS_WGS_1984", "D_WGS_1984", kWgs84, "\"Ferro\",-17.66666666666667"),
        geographic("GCS_WGS_1984", "D_WGS_1984", kWgs84, "\"Paris\",2.337229166666667")}) {
    EXPECT_NE(why_not(system, 15.6, 48.41).find("no way from there"), std::string::npos)
        << why_not(system, 15.6, 48.41);
  }
  EXPECT_NE(why_not("EPSG:2056", 12'600'000, 1'200'000), "taken") << "far from Switzerland";
}

TEST(ReferenceSystem, IsRefusedIfItIsNoneOfTheGround) {
  for (const std::string system : {"LOCAL_CS[\"site\",UNIT[\"metre\",1]]", "EPSG:5776", "EPSG:4978",
                                   "EPSG:1149", "what else", "PROJCS[\"ETRS89\"]"}) {
    EXPECT_NE(why_not(system, 15.6, 48.41), "taken") << system;
  }
}

TEST(ReferenceSystem, LosesItsHeightsAndItsOwnShifts) {
  GeoMap map = map_at(444'500, 3'688'500);
  to_wgs84("EPSG:32638+5773", map);
  EXPECT_NEAR(map.areas[0].rings[0][0].latitude, 33.33424, 1e-5);
  EXPECT_NE(map.remark.find("heights are ignored"), std::string::npos);
  // A shift of nobody knows how many metres, as GDAL writes it, is not believed.
  const std::string shifted =
      "GEOGCS[\"MGI\",DATUM[\"Militar-Geographische_Institut\",SPHEROID[" + kBessel +
      "],TOWGS84[577,90,463,5,1,5,2]],PRIMEM[\"Greenwich\",0],UNIT[\"degree\",0.0174532925199433],"
      "AUTHORITY[\"EPSG\",\"4312\"]]";
  EXPECT_NE(why_not(shifted, 15.6, 48.41).find("1.5 m"), std::string::npos)
      << why_not(shifted, 15.6, 48.41);
}

TEST(ReferenceSystem, RefusesWhatIsNotOnEarthByItsId) {
  GeoMap map = map_at(15.6, 48.41);
  map.areas.push_back({.rings = {{{91, 15.6}, {48, 15}, {48, 16}}}, .id = "shape 1"});
  map.areas.push_back({.rings = {{{48, 15}, {48, 16}, {49, 15}}}, .id = "shape 1"});
  to_wgs84("", map);
  EXPECT_EQ(map.areas.size(), 1U);
  EXPECT_EQ(map.census.of(Census::Column::kRefused, "place that is not on earth"), 1U);
  EXPECT_GT(map.box.box(false).south, 48.4);
}

}  // namespace
}  // namespace iog::tools
