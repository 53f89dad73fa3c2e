// Where beams are low, by whole numbers asked of each distance one by one; of a tilted sensor by
// where its beams end.
#include "ground/low_beams.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>

#include "fakes/effort.hpp"
#include "fakes/middle_beam.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"

namespace iog::ground {
namespace {

using tests::Random;

// Rough ground, in some sectors as no turn makes it.
Surface rough_surface(Random& random) {
  Surface surface;
  for (std::size_t sector = 0; sector < kSectors; ++sector) {
    const std::int32_t most = random.one_in(4) ? 3'000 : 300;
    std::int32_t height = 0;
    for (std::int16_t& start : surface.renew(sector)) {
      start = static_cast<std::int16_t>(height);
      height = std::clamp<std::int32_t>(height + random.between(-most, most), -14'000, 14'000);
    }
  }
  return surface;
}

// A beam's height over a limit over the ground, in units of 2^-24 mm, times the length of a bin:
// below 2^62.
std::int64_t over(const Beams& beams, const Surface::Row& row, std::size_t layer,
                  std::int64_t along_mm, std::int32_t limit_mm) {
  const std::int64_t length = beams.bins().length_mm();
  const std::int64_t bin = std::min<std::int64_t>(along_mm / length, 63);
  const std::int64_t start = row[static_cast<std::size_t>(bin)];
  const std::int64_t rise = row[static_cast<std::size_t>(bin) + 1] - start;
  return (beams.origin_mm() - start - limit_mm) * length * (1 << 24) +
         std::int64_t{beams.slope(layer)} * along_mm * length -
         rise * (along_mm - bin * length) * (1 << 24);
}

// So far all of a beam is on its side of what is asked, in steps of 2 mm.
template <typename IsOnItsSide>
std::int64_t stays_to(const Beams& beams, IsOnItsSide is_on_its_side) {
  std::int64_t to = -2;
  while (to + 2 <= beams.range_mm() && is_on_its_side(to + 2)) {
    to += 2;
  }
  return std::max<std::int64_t>(to, 0);
}

std::unique_ptr<LowBeams> low_beams_of(const Beams& beams, const vehicle::Sensor& sensor,
                                       std::int32_t low_mm, const Surface& surface) {
  auto its = std::make_unique<LowBeams>();
  Fan fan(beams, sensor);
  for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
    fan.turn_to(sector);
    its->find(sector, fan, low_mm, surface);
  }
  return its;
}

void expect_exact(const vehicle::Sensor& sensor, std::int32_t low_mm, std::uint64_t seed) {
  Random random(seed);
  const Beams beams(sensor);
  const Surface surface = rough_surface(random);
  const auto low_beams = low_beams_of(beams, sensor, low_mm, surface);
  const bool comes_down = beams.origin_mm() > low_mm;
  for (std::uint32_t sector = 0; sector < kSectors;
       sector += static_cast<std::uint32_t>(tests::effort(17, 51))) {
    const Surface::Row& row = surface.row(sector);
    const Surface::Row lowest = surface.lowest_near(sector);
    for (const std::uint8_t layer : beams.from_below()) {
      const std::int64_t low_mm_to = stays_to(beams, [&](std::int64_t along_mm) {
        const std::int64_t height = over(beams, lowest, layer, along_mm, low_mm);
        return comes_down ? height >= 0 : height <= 0;
      });
      // Lower it may pass under a car, if the sensor is not itself so low.
      const std::int64_t over_cars_to = stays_to(beams, [&](std::int64_t along_mm) {
        return beams.origin_mm() <= 300 || over(beams, row, layer, along_mm, 300) >= 0;
      });
      const LowBeams::Stretch low = low_beams->at(sector, layer);
      ASSERT_EQ(low.from_mm, comes_down ? low_mm_to : 0)
          << "sector " << sector << " layer " << int{layer};
      ASSERT_EQ(low.to_mm, comes_down ? over_cars_to : std::min(low_mm_to, over_cars_to))
          << "sector " << sector << " layer " << int{layer};
    }
  }
}

TEST(LowBeams, BeginWhereAHighSensorsComeDownToTheLowestGround) {
  expect_exact(tests::LevelVlp16::kVehicle.sensors[0], 600, 31);
  expect_exact(tests::HighAndFar::kVehicle.sensors[1], 400, 32);
}

TEST(LowBeams, EndWhereALowSensorsRiseOverIt) {
  expect_exact(tests::LevelVlp16::kVehicle.sensors[0], 1'700, 33);
  expect_exact(tests::HighAndFar::kVehicle.sensors[1], 1'600, 34);
}

// Where they have come down to 0.6 m by the height of a beam's end, which the mount says, in the
// middle of a sector: up to there they are higher all the way. A tilt of 11 degrees: a car's plane
// falls away by 0.19 m a metre.
TEST(LowBeams, OfATiltedSensorFollowTheirSector) {
  const vehicle::Sensor& sensor = tests::MixedCar::kVehicle.sensors[1];
  ASSERT_FALSE(sensor.layers_share_lines);
  const Beams beams(sensor);
  Random random(35);
  const Surface surface = rough_surface(random);
  const auto low_beams = low_beams_of(beams, sensor, 600, surface);
  int come_down = 0;
  for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
    const Surface::Row lowest = surface.lowest_near(sector);
    for (const std::uint8_t layer : beams.from_below()) {
      const tests::MiddleBeam beam(beams, sensor, sector, layer);
      const auto over_low = [&](std::uint32_t along_mm) {
        return beam.height_over_mm(lowest, along_mm) - 600;
      };
      const std::uint32_t border_mm = low_beams->at(sector, layer).from_mm;
      for (std::uint32_t along_mm = 0; along_mm + 4 < border_mm; along_mm += 128) {
        ASSERT_GE(over_low(along_mm), -2) << sector << ", " << int{layer} << ", " << along_mm;
      }
      if (border_mm + 4 < beams.range_mm() && beam.has_ground_at(border_mm)) {
        ASSERT_LE(over_low(border_mm + 6), 20) << sector << ", " << int{layer};
        ++come_down;
      }
    }
  }
  EXPECT_GT(come_down, 500);
}

}  // namespace
}  // namespace iog::ground
