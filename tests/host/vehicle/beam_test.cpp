// Directions against floating-point trigonometry, fates against the table in section 6 of
// docs/model.md.
#include "vehicle/beam.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "geometry/grid.hpp"
#include "lidar/ibeo_lux.hpp"

namespace iog::vehicle {
namespace {

using tests::SteepVlp16;
using tests::TiltedLux;

struct Vector {
  double x;
  double y;
  double z;
};

Vector about_z(Vector v, double angle) {
  return {v.x * std::cos(angle) - v.y * std::sin(angle),
          v.x * std::sin(angle) + v.y * std::cos(angle), v.z};
}
Vector about_y(Vector v, double angle) {
  return {v.x * std::cos(angle) + v.z * std::sin(angle), v.y,
          -v.x * std::sin(angle) + v.z * std::cos(angle)};
}
Vector about_x(Vector v, double angle) {
  return {v.x, v.y * std::cos(angle) - v.z * std::sin(angle),
          v.y * std::sin(angle) + v.z * std::cos(angle)};
}

// The end of a beam by one rotation after the other: roll first, yaw last.
Vector end_of(const description::MountConfig& mount, double azimuth, double elevation,
              double length_m) {
  const double degree = std::acos(-1.0) / 180;
  Vector v{std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
           std::sin(elevation)};
  v = about_z(about_y(about_x(v, mount.roll_deg * degree), mount.pitch_deg * degree),
              mount.yaw_deg * degree);
  return {mount.x_m + length_m * v.x, mount.y_m + length_m * v.y, mount.z_m + length_m * v.z};
}

template <typename Car>
void expect_every_direction_right() {
  const double degree = std::acos(-1.0) / 180;
  const Sensor& sensor = Car::kVehicle.sensors[0];
  for (std::uint8_t layer = 0; layer < 4; ++layer) {
    const double elevation = lidar::IbeoLux::kElevationsDeg[layer] * degree;
    for (int tick = 0; tick < 11520; tick += tests::effort(1, 7)) {
      const Beam beam = aim(sensor, layer, static_cast<std::uint16_t>(tick));
      const Vector end = end_of(Car::kConfigs[0].mount, tick * degree / 32, elevation, 50);
      const auto& x = beam.line.x();
      const auto& y = beam.line.y();
      const std::int32_t end_x = sensor.origin.x + x.step() * static_cast<std::int32_t>(x.length());
      const std::int32_t end_y = sensor.origin.y + y.step() * static_cast<std::int32_t>(y.length());
      // Half a subcell of rounding and 0.002 of the coefficients' own.
      ASSERT_NEAR(end_x, (end.x + 51.2) * geometry::kSubcellsPerMetre, 0.503) << tick;
      ASSERT_NEAR(end_y, (end.y + 51.2) * geometry::kSubcellsPerMetre, 0.503) << tick;
      ASSERT_NEAR(beam.end_z, end.z * geometry::kSubcellsPerMetre, 0.503) << tick;
    }
  }
}

TEST(Beam, EndsWhereTrigonometrySaysStraight) { expect_every_direction_right<tests::OneLux>(); }
TEST(Beam, EndsWhereTrigonometrySaysTilted) { expect_every_direction_right<TiltedLux>(); }

// From 1.5 m above the ground the steepest leave the height band, 0.3 to 2.2 m, after
// 1.2 / tan 89 degrees = 0.0209 m downwards and 0.7 / tan 89 degrees = 0.0122 m upwards.
TEST(Beam, EndsWhereTrigonometrySaysSteep) {
  const Sensor& sensor = SteepVlp16::kVehicle.sensors[0];
  for (std::uint8_t layer = 0; layer < sensor.layer_count; ++layer) {
    const double elevation = SteepVlp16::kElevationsDeg.at(layer) * std::acos(-1.0) / 180;
    EXPECT_NEAR(aim(sensor, layer, 0).end_z,
                (1.5 + 130 * std::tan(elevation)) * geometry::kSubcellsPerMetre, 0.503);
  }
  EXPECT_EQ(ranges_in_band(sensor, aim(sensor, 0, 0).end_z), (Ranges{0, 20}));
  EXPECT_EQ(ranges_in_band(sensor, aim(sensor, 15, 0).end_z), (Ranges{0, 12}));
}

Classification fate_of(const lidar::ScanPoint& point) {
  const Sensor& sensor = TiltedLux::kVehicle.sensors[0];
  const Beam beam = aim(sensor, point.layer, point.azimuth_ticks);
  return classify(sensor, beam, point);
}

void expect_fate(const lidar::ScanPoint& point, Fate fate, bool carves, bool marks) {
  const Classification classification = fate_of(point);
  EXPECT_EQ(static_cast<int>(classification.fate), static_cast<int>(fate));
  EXPECT_EQ(classification.evidence.carves(), carves);
  EXPECT_EQ(classification.evidence.marks(), marks);
}

TEST(Fate, EachPointHasExactlyOne) {
  expect_fate({.range_mm = 5'000, .layer = 2}, Fate::kUsed, true, true);
  expect_fate({.range_mm = 0, .layer = 2}, Fate::kNoReturn, true, false);
  expect_fate({.range_mm = 0, .layer = 2, .echo = 1}, Fate::kNoReturn, false, false);
  expect_fate({.range_mm = 299, .layer = 2}, Fate::kTooNear, false, false);
  expect_fate({.range_mm = 300, .layer = 2}, Fate::kUsed, true, true);
  expect_fate({.range_mm = 5'000, .layer = 2, .echo = 1}, Fate::kLaterEcho, false, true);
  expect_fate({.range_mm = 50'001, .layer = 2}, Fate::kTooFar, true, false);
  expect_fate({.range_mm = 50'001, .layer = 2, .echo = 2}, Fate::kTooFar, false, false);
  expect_fate({.range_mm = 5'000, .layer = 2, .is_ground = true}, Fate::kFlagged, true, false);
  expect_fate({.range_mm = 5'000, .layer = 2, .echo = 1, .is_ground = true}, Fate::kFlagged, false,
              false);
  expect_fate({.range_mm = 5'000, .layer = 2, .is_dirt = true}, Fate::kFlagged, false, false);
  expect_fate({.range_mm = 5'000, .layer = 2, .is_rain = true}, Fate::kFlagged, false, false);
}

// Pitched down by 1.9 degrees, layer 0 (-1.2 degrees) falls from 0.5 m to below 0.2 m after
// 0.3 / tan 3.1 degrees = 5.54 m.
TEST(Fate, AnEndBelowTheBandOnlyCarves) {
  expect_fate({.range_mm = 5'400, .layer = 0}, Fate::kUsed, true, true);
  expect_fate({.range_mm = 5'700, .layer = 0}, Fate::kOutsideHeightBand, true, false);
  expect_fate({.range_mm = 5'700, .layer = 0, .echo = 1}, Fate::kOutsideHeightBand, false, false);
}

// The sensor stands 0.23 m in front of the car's front at x = 1. Turned by 23.7 degrees, it looks
// straight back at 156.3 degrees: 1 m ends on the car, 9 m behind it.
TEST(Fate, APointOnTheCarItselfIsDropped) {
  expect_fate({.range_mm = 1'000, .azimuth_ticks = 5002, .layer = 2}, Fate::kTooNear, false, false);
  expect_fate({.range_mm = 9'000, .azimuth_ticks = 5002, .layer = 2}, Fate::kUsed, true, true);
}

// Asked with the product itself, range by range.
bool lies_between(const RangeProducts& limits, std::int32_t extent, std::uint32_t range_mm) {
  const std::int64_t product = std::int64_t{extent} * range_mm;
  return limits.low <= product && product <= limits.high;
}

// Ends of the ranges, and their neighbours, where one millimetre more or less decides.
TEST(Ranges, AreThoseOfWhichTheProductIsBetweenTheLimits) {
  tests::Random random(5);
  int divided = 0;
  for (int i = 0; i < tests::effort(100'000, 2'000); ++i) {
    const std::int32_t extent = random.between(-(1 << 20), 1 << 20) / (1 << random.between(0, 20));
    const auto from = static_cast<std::uint32_t>(random.between(0, 400));
    const std::uint32_t to = from + static_cast<std::uint32_t>(random.between(0, 60'000));
    // Often exactly at a product, or one beside it.
    const auto limit = [&] {
      return std::int64_t{extent} * random.between(-100, 60'500) + random.between(-1, 1);
    };
    const std::int64_t one = limit();
    const std::int64_t other = limit();
    const RangeProducts limits{std::min(one, other), std::max(one, other)};
    const Ranges found = ranges_between(limits, extent, from, to);
    const auto expect_right = [&](std::uint32_t range_mm) {
      ASSERT_EQ(found.contain(range_mm), lies_between(limits, extent, range_mm))
          << extent << " * " << range_mm << " in " << limits.low << " ... " << limits.high;
    };
    for (const std::uint32_t near : {from, to, found.first, found.first + found.width}) {
      for (std::uint32_t range_mm = std::max(near, from + 2) - 2;
           range_mm <= std::min(to, near + 2); ++range_mm) {
        expect_right(range_mm);
      }
    }
    expect_right(
        from + static_cast<std::uint32_t>(random.between(0, static_cast<std::int32_t>(to - from))));
    divided += found.first > from || found.first + found.width < to ? 1 : 0;
  }
  EXPECT_GT(divided, tests::effort(10'000, 200));
}

// The order of the tests in docs/model.md section 6, with products in place of ranges.
Fate fate_by_products(const Sensor& sensor, const Beam& beam, std::uint32_t range_mm) {
  const auto extent = [](const auto& axis) {
    return axis.step() * static_cast<std::int32_t>(axis.length());
  };
  if (range_mm < sensor.range_min_mm ||
      (lies_between(sensor.on_car_x, extent(beam.line.x()), range_mm) &&
       lies_between(sensor.on_car_y, extent(beam.line.y()), range_mm))) {
    return Fate::kTooNear;
  }
  if (range_mm > 50'000) {
    return Fate::kTooFar;
  }
  return lies_between(sensor.in_band, beam.end_z - sensor.origin_z, range_mm)
             ? Fate::kUsed
             : Fate::kOutsideHeightBand;
}

TEST(Fate, OfEveryRangeIsThatOfItsProducts) {
  const Sensor& sensor = TiltedLux::kVehicle.sensors[0];
  constexpr auto kTicks = static_cast<std::uint16_t>(tests::effort(96, 1440));
  std::array<int, kFateCount> seen{};
  for (std::uint16_t tick = 0; tick < 11520; tick += kTicks) {
    for (std::uint8_t layer = 0; layer < 4; ++layer) {
      const Beam beam = aim(sensor, layer, tick);
      const BeamRanges ranges = ranges_of(sensor, beam);
      for (std::uint32_t range_mm = 1; range_mm < 51'000; ++range_mm) {
        const Fate fate =
            classify(sensor, ranges, {.range_mm = range_mm, .azimuth_ticks = tick, .layer = layer})
                .fate;
        ASSERT_EQ(fate, fate_by_products(sensor, beam, range_mm)) << tick << ", " << range_mm;
        ++seen[static_cast<std::size_t>(fate)];
      }
    }
  }
  for (const Fate fate : {Fate::kUsed, Fate::kTooNear, Fate::kTooFar, Fate::kOutsideHeightBand}) {
    EXPECT_GT(seen[static_cast<std::size_t>(fate)], 0);
  }
}

TEST(HeightBand, IsWholeWhereBothEndsAreInside) {
  const Sensor& sensor = TiltedLux::kVehicle.sensors[0];
  const Beam beam = aim(sensor, 0, 0);
  EXPECT_TRUE(part_in_band(TiltedLux::kVehicle.band(), sensor, beam.end_z, 5'000).is_whole);
}

// Both limits belong to the band.
TEST(HeightBand, AnEndOnALimitIsInside) {
  const Sensor& sensor = TiltedLux::kVehicle.sensors[0];
  for (const std::int32_t end_z : {sensor.origin_z - 100, sensor.origin_z + 100}) {
    const bool rises = end_z > sensor.origin_z;
    const auto is_whole = [&](std::int32_t less) {
      const HeightBand band{.low = rises ? sensor.origin_z : end_z + less,
                            .high = rises ? end_z - less : sensor.origin_z};
      return part_in_band(band, sensor, end_z, sensor.range.mm()).is_whole;
    };
    EXPECT_TRUE(is_whole(0));
    EXPECT_FALSE(is_whole(1));
  }
}

TEST(HeightBand, EndsWhereTheBeamLeavesIt) {
  const Sensor& sensor = TiltedLux::kVehicle.sensors[0];
  const Beam beam = aim(sensor, 0, 0);
  const BandPart part = part_in_band(TiltedLux::kVehicle.band(), sensor, beam.end_z, 50'000);
  ASSERT_FALSE(part.is_whole || part.is_empty);
  EXPECT_EQ(part.from.numerator, 0U);
  const double leaves_m =
      50.0 * static_cast<double>(part.to.numerator) / static_cast<double>(part.to.denominator);
  EXPECT_NEAR(leaves_m, 5.54, 0.02);
}

TEST(HeightBand, ASensorOutsideTheBandSeesOnlyWhereItsBeamEnters) {
  Vehicle high = TiltedLux::kVehicle;
  high.z_min = static_cast<std::int32_t>(-2 * geometry::kSubcellsPerMetre);
  high.z_max = static_cast<std::int32_t>(0.2 * geometry::kSubcellsPerMetre);
  const Sensor& sensor = high.sensors[0];
  const BandPart down = part_in_band(high.band(), sensor, aim(sensor, 0, 0).end_z, 50'000);
  ASSERT_FALSE(down.is_whole || down.is_empty);
  EXPECT_NEAR(
      50.0 * static_cast<double>(down.from.numerator) / static_cast<double>(down.from.denominator),
      5.54, 0.02);
  const BandPart up = part_in_band(high.band(), sensor, aim(sensor, 3, 5760).end_z, 50'000);
  EXPECT_TRUE(up.is_empty);
}

TEST(HeightBand, ALevelBeamIsInItAllTheWayOrNever) {
  const Sensor& sensor = TiltedLux::kVehicle.sensors[0];
  const std::int32_t level = sensor.origin_z;
  for (const HeightBand band :
       {HeightBand{level + 1, level + 9}, HeightBand{level - 9, level - 1}}) {
    EXPECT_TRUE(part_in_band(band, sensor, level, 50'000).is_empty);
  }
  EXPECT_TRUE(part_in_band({level - 9, level}, sensor, level, 50'000).is_whole);
}

}  // namespace
}  // namespace iog::vehicle
