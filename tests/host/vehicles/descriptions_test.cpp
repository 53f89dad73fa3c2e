// What the descriptions that others rely on say. What any description must keep to is checked where
// it is compiled (description/car_checks.hpp).
#include <cmath>
#include <gtest/gtest.h>

#include "geometry/grid.hpp"
#include "vehicles/all_vehicles.hpp"

namespace iog::vehicles {
namespace {

// The name of the reference car in a stream, which tests/e2e/vehicle_id.py has, too.
TEST(Descriptions, TheReferenceCarHasItsName) {
  EXPECT_EQ(reference_car::kVehicle.id, 0x01FFB0CDU);
}

// docs/model.md section 8: four LUX, three in front and one behind, 50 m, 4 layers.
TEST(Descriptions, TheReferenceCarIsThatOfTheThesis) {
  const vehicle::Vehicle& car = reference_car::kVehicle;
  ASSERT_EQ(car.sensors.size(), 4U);
  EXPECT_EQ(car.frame_period_us, 40'000U);
  EXPECT_EQ(car.rule, vehicle::FusionRule::kHitsWin);
  const std::int32_t centre = geometry::kOriginCell * geometry::kResolution;
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(car.sensors[i].range.mm(), 50'000U);
    EXPECT_EQ(car.sensors[i].precision_mm, 100U);
    EXPECT_EQ(car.sensors[i].layer_count, 4);
    EXPECT_EQ(car.sensors[i].origin.x > centre, i < 3) << car.sensors[i].name;
  }
}

// The first and the last laser of calibration/made_up_hdl64e.xml, and the arithmetic of
// docs/sensors.md: a beam that starts v across itself counts v tan(elevation) less.
TEST(Descriptions, ACalibratedUnitHasTheLasersOfItsFile) {
  const vehicle::Sensor& sensor = roof_hdl64e::kVehicle.sensors[0];
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
  EXPECT_TRUE(roof_vlp32c::kVehicle.sensors[0].unit().corrections.empty());
}

// The first and the last row of calibration/made_up_os1_64.json, and its mode. Azimuths there are
// clockwise; a degree is 128 ticks.
TEST(Descriptions, AnOusterHasTheRowsAndTheModeOfItsMetadata) {
  const lidar::Unit unit = roof_os1_64::kVehicle.sensors[0].unit();
  ASSERT_EQ(unit.corrections.size(), 64U);
  EXPECT_EQ(unit.corrections[0].azimuth_ticks, -397);  // 3.1
  EXPECT_EQ(unit.corrections[63].azimuth_ticks, 410);  // -3.2
  EXPECT_EQ(unit.columns_per_turn, 1024);
  EXPECT_EQ(unit.column_ns, 97'656U);
  EXPECT_NEAR(roof_os1_64::kSensorConfigs[0].lasers[63].elevation_deg, -16.6, 1e-9);
}

// calibration/made_up_pandar64.csv: clockwise, and its channels count from 1.
TEST(Descriptions, AHesaiHasTheChannelsOfItsFile) {
  const auto corrections = roof_pandar64::kVehicle.sensors[0].unit().corrections;
  ASSERT_EQ(corrections.size(), 64U);
  EXPECT_EQ(corrections[0].azimuth_ticks, 104);  // -1.042
  EXPECT_NEAR(roof_pandar64::kSensorConfigs[0].lasers[0].elevation_deg, 14.7, 1e-9);
  EXPECT_TRUE(roof_xt32::kVehicle.sensors[0].unit().corrections.empty());
}

}  // namespace
}  // namespace iog::vehicles
