// What the cars of vehicles/ have become that others rely on, as their blocks have it.
#include <cmath>
#include <gtest/gtest.h>
#include <vector>

#include "geometry/grid.hpp"
#include "vehicles/cars.hpp"

namespace iog::vehicles {
namespace {

const vehicle::Sensor& first_sensor_of(std::string_view name) {
  return car(name).vehicle.sensors[0];
}

// Of a layer of a level sensor that turns: its beam ends L tan(elevation) over its origin.
double elevation_deg(const vehicle::Sensor& sensor, std::size_t layer) {
  const double end_z = std::ldexp(sensor.layers[layer].z.base, -vehicle::kAxisFractionBits);
  const double length = sensor.range.mm() / 1000.0 * geometry::kSubcellsPerMetre;
  return std::atan((end_z - sensor.origin_z) / length) * 180 / 3.14159265358979;
}

// The name of the reference car in a stream, which tests/e2e/vehicle_id.py has, too.
TEST(Descriptions, TheReferenceCarHasItsName) {
  EXPECT_EQ(car("reference_car").vehicle.id, 0x01FFB0CDU);
}

// docs/model.md section 8: four LUX, three in front and one behind, 50 m, 4 layers.
TEST(Descriptions, TheReferenceCarIsThatOfTheThesis) {
  const vehicle::Vehicle& vehicle = car("reference_car").vehicle;
  ASSERT_EQ(vehicle.sensors.size(), 4U);
  EXPECT_EQ(vehicle.frame_period_us, 40'000U);
  EXPECT_EQ(vehicle.rule, vehicle::FusionRule::kHitsWin);
  const std::int32_t centre = geometry::kOriginCell * geometry::kResolution;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(vehicle.sensors[i].range.mm(), 50'000U);
    EXPECT_EQ(vehicle.sensors[i].precision_mm, 100U);
    EXPECT_EQ(vehicle.sensors[i].layer_count, 4);
    EXPECT_EQ(vehicle.sensors[i].origin.x > centre, i < 3) << vehicle.sensors[i].name;
  }
}

// Table 4.3 of the thesis, by blurring: cells k - 4 to k + 2.
TEST(Descriptions, TheReferenceCarHasTheIndexesOfTheThesis) {
  for (const vehicle::Sensor& sensor : car("reference_car").vehicle.sensors) {
    std::vector<int> indexes;
    for (int offset = -4; offset <= 2; ++offset) {
      indexes.push_back(sensor.profile.at(offset));
    }
    EXPECT_EQ(indexes, (std::vector{-14, -14, -7, 0, 2, 0, 0})) << sensor.name;
  }
}

// The first and the last laser of calibration/made_up_hdl64e.xml, and the arithmetic of
// docs/sensors.md: a beam that starts v across itself counts v tan(elevation) less.
TEST(Descriptions, ACalibratedUnitHasTheLasersOfItsFile) {
  const vehicle::Sensor& sensor = first_sensor_of("roof_hdl64e");
  const auto corrections = sensor.unit().corrections;
  ASSERT_EQ(corrections.size(), 64U);
  const auto expect_laser = [&](std::size_t laser, double rotation_deg, double vertical_deg,
                                double distance_cm, double offset_cm) {
    const double elevation = vertical_deg * 3.14159265358979 / 180;
    EXPECT_NEAR(corrections[laser].azimuth_ticks, rotation_deg * 100, 0.51);
    EXPECT_NEAR(corrections[laser].range_mm, 10 * (distance_cm - offset_cm * std::tan(elevation)),
                0.51);
  };
  expect_laser(0, 5.3521, -3.3381, 119.14, 21.49);
  expect_laser(63, -1.0030, -15.3130, 120.72, 14.26);
  EXPECT_TRUE(first_sensor_of("roof_vlp32c").unit().corrections.empty());
  const vehicle::Sensor& vls128 = first_sensor_of("roof_vls128");
  EXPECT_TRUE(vls128.unit().corrections.empty());
  EXPECT_NEAR(elevation_deg(vls128, 36), -25, 1e-4);
}

// The first and the last row of calibration/made_up_os1_64.json, and its mode. Azimuths there are
// clockwise; a degree is 128 ticks.
TEST(Descriptions, AnOusterHasTheRowsAndTheModeOfItsMetadata) {
  const vehicle::Sensor& sensor = first_sensor_of("roof_os1_64");
  const lidar::Unit unit = sensor.unit();
  ASSERT_EQ(unit.corrections.size(), 64U);
  EXPECT_EQ(unit.corrections[0].azimuth_ticks, -397);  // 3.1
  EXPECT_EQ(unit.corrections[63].azimuth_ticks, 410);  // -3.2
  EXPECT_EQ(unit.columns_per_turn, 1024);
  EXPECT_EQ(unit.column_ns, 97'656U);
  EXPECT_NEAR(elevation_deg(sensor, 63), -16.6, 1e-4);
}

// calibration/made_up_os0_128.json: no unit has more rows.
TEST(Descriptions, AnOusterMayHave128Rows) {
  const vehicle::Sensor& sensor = first_sensor_of("roof_os0_128");
  ASSERT_EQ(sensor.unit().corrections.size(), 128U);
  EXPECT_EQ(sensor.unit().corrections[127].azimuth_ticks, 1229);  // -9.6
  EXPECT_NEAR(elevation_deg(sensor, 127), -45, 1e-4);
}

// calibration/made_up_pandar64.csv: clockwise, and its channels count from 1.
TEST(Descriptions, AHesaiHasTheChannelsOfItsFile) {
  const vehicle::Sensor& sensor = first_sensor_of("roof_pandar64");
  const auto corrections = sensor.unit().corrections;
  ASSERT_EQ(corrections.size(), 64U);
  EXPECT_EQ(corrections[0].azimuth_ticks, 104);  // -1.042
  EXPECT_NEAR(elevation_deg(sensor, 0), 14.7, 1e-4);
  EXPECT_TRUE(first_sensor_of("roof_xt16").unit().corrections.empty());
  EXPECT_TRUE(first_sensor_of("roof_xt32").unit().corrections.empty());
  EXPECT_TRUE(first_sensor_of("roof_xt32m").unit().corrections.empty());
}

// calibration/made_up_qt64.csv
TEST(Descriptions, AQt64LooksSteeplyUpAndDown) {
  const vehicle::Sensor& sensor = first_sensor_of("roof_qt64");
  const auto corrections = sensor.unit().corrections;
  ASSERT_EQ(corrections.size(), 64U);
  EXPECT_EQ(corrections[0].azimuth_ticks, -728);  // 7.28
  EXPECT_EQ(corrections[63].azimuth_ticks, 668);  // -6.68
  EXPECT_NEAR(elevation_deg(sensor, 0), -52.03, 1e-4);
  EXPECT_NEAR(elevation_deg(sensor, 63), 52.03, 1e-4);
}

// calibration/made_up_qt128.csv
TEST(Descriptions, AQt128LooksSteeplyUpAndDownToo) {
  const vehicle::Sensor& sensor = first_sensor_of("roof_qt128");
  const auto corrections = sensor.unit().corrections;
  ASSERT_EQ(corrections.size(), 128U);
  EXPECT_EQ(corrections[0].azimuth_ticks, -1010);  // 10.1
  EXPECT_EQ(corrections[127].azimuth_ticks, 1010);
  EXPECT_NEAR(elevation_deg(sensor, 0), -52.4, 1e-4);
  EXPECT_NEAR(elevation_deg(sensor, 127), 52.4, 1e-4);
}

// calibration/made_up_pandar40p.csv
TEST(Descriptions, APandar40pLooksByTurnsToTheSides) {
  const vehicle::Sensor& sensor = first_sensor_of("roof_pandar40p");
  const auto corrections = sensor.unit().corrections;
  ASSERT_EQ(corrections.size(), 40U);
  EXPECT_EQ(corrections[0].azimuth_ticks, 104);   // -1.042
  EXPECT_EQ(corrections[6].azimuth_ticks, -313);  // 3.125
  EXPECT_EQ(corrections[7].azimuth_ticks, 521);   // -5.208
  EXPECT_NEAR(elevation_deg(sensor, 39), -25, 1e-4);
}

}  // namespace
}  // namespace iog::vehicles
