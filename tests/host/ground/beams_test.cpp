// Where returns lie, beside sines and cosines of the mount and the data sheet.
#include "ground/beams.hpp"

#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "vehicle/beam.hpp"

namespace iog::ground {
namespace {

using tests::Random;

// Velodyne VLP-16 User Manual 63-9243, table "Vertical Angles by Laser ID", in degrees.
constexpr std::array<double, 16> kElevations{-15, 1, -13, 3,  -11, 5,  -9, 7,
                                             -7,  9, -5,  11, -3,  13, -1, 15};
constexpr double kRadians = 3.14159265358979323846 / 180;

TEST(Bins, AreTwiceAsLongWhereLinesAreLong) {
  EXPECT_EQ(Bins(50'000).length_mm(), 1'024U);
  EXPECT_EQ(Bins(65'536).length_mm(), 1'024U);
  EXPECT_EQ(Bins(65'537).length_mm(), 2'048U);
  EXPECT_EQ(Bins(130'000).bin_of(129'999), 63U);
  EXPECT_EQ(Bins(50'000).most_plausible_mm(3), 1'200);
  EXPECT_EQ(Bins(50'000).most_plausible_mm(63), 14'000);
  EXPECT_EQ(Bins(130'000).most_plausible_mm(3), 2'100);
}

TEST(Beams, OfALevelSensorRiseByTheirElevation) {
  const vehicle::Sensor& sensor = tests::LevelVlp16::kVehicle.sensors[0];
  const Beams beams(sensor);
  const double origin_mm = tests::LevelVlp16::kConfigs[0].mount.z_m * 1000;
  Random random(1);
  for (int i = 0; i < 5'000; ++i) {
    const std::size_t layer = random.below(16);
    const std::int32_t range = random.between(0, (1 << 20) - 1);
    const double elevation = kElevations[layer] * kRadians;
    const std::uint32_t out = beams.out_mm(layer, static_cast<std::uint32_t>(range));
    ASSERT_NEAR(out, range * std::cos(elevation), 1.01);
    // A line's end is a whole number of subcells high: a tenth of a millimetre at its end.
    ASSERT_NEAR(beams.height_mm(beams.slope(layer), out), origin_mm + range * std::sin(elevation),
                1.5 + range * 2e-6);
  }
}

// 11 degrees down, turned by 80: heights over the car's plane of what is so far along a beam.
TEST(Beams, OfATiltedSensorHaveHeightsOverTheCarsPlane) {
  const vehicle::Sensor& sensor = tests::MixedCar::kVehicle.sensors[1];
  const Beams beams(sensor);
  const auto& mount = tests::MixedCar::kConfigs[1].mount;
  const double pitch = mount.pitch_deg * kRadians;
  Random random(2);
  for (int i = 0; i < 5'000; ++i) {
    const std::size_t layer = random.below(16);
    const auto step = static_cast<std::uint32_t>(random.below(sensor.azimuths.steps_per_turn()));
    const std::int32_t range = random.between(0, (1 << 20) - 1);
    const double azimuth = 2 * 180 * kRadians * step / sensor.azimuths.steps_per_turn();
    const double elevation = kElevations[layer] * kRadians;
    const double up = std::sin(elevation) * std::cos(pitch) -
                      std::cos(elevation) * std::cos(azimuth) * std::sin(pitch);
    const std::int32_t end =
        vehicle::end_height_of(sensor.layers[layer], vehicle::direction_of(sensor, step));
    ASSERT_NEAR(beams.out_mm(layer, static_cast<std::uint32_t>(range)), range * std::cos(elevation),
                1.01);
    ASSERT_NEAR(beams.height_mm(beams.slope_to(end), static_cast<std::uint32_t>(range)),
                mount.z_m * 1000 + range * up, 1.5 + range * 2e-6);
  }
}

TEST(Beams, HaveSectorsOfWholeSteps) {
  for (const vehicle::Sensor& sensor :
       {tests::LevelVlp16::kVehicle.sensors[0], tests::MixedCar::kVehicle.sensors[1]}) {
    const Beams beams(sensor);
    const std::uint32_t steps = sensor.azimuths.steps_per_turn();
    for (std::uint32_t step = 0; step < steps; ++step) {
      ASSERT_EQ(beams.sector_of(step), step * kSectors / steps);
    }
  }
}

// Of the eleven that look down most, -15 to 5 degrees, every second one.
TEST(Beams, SampleLayersThatLookDown) {
  for (const vehicle::Sensor& sensor :
       {tests::LevelVlp16::kVehicle.sensors[0], tests::MixedCar::kVehicle.sensors[1]}) {
    const Beams beams(sensor);
    const std::array<std::uint8_t, 6> expected{0, 4, 8, 12, 1, 5};
    const lidar::Sampling sampling = beams.sampling();
    EXPECT_TRUE(std::ranges::equal(sampling.layers, expected));
    EXPECT_EQ(sampling.log2_firings, 3);
    EXPECT_EQ(beams.fewest_samples(), 12);
  }
}

}  // namespace
}  // namespace iog::ground
