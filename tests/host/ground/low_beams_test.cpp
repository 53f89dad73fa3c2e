// Where beams are low, by whole numbers asked of each distance one by one; of a tilted sensor by
// where its beams end.
#include "ground/low_beams.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "ground/beams.hpp"
#include "ground/surface.hpp"
#include "vehicle/beam.hpp"

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

std::int32_t lowest_of(const Surface::Row& row, std::int64_t start) {
  std::int32_t lowest = row[static_cast<std::size_t>(start)];
  for (std::int64_t near = 0; near < std::ssize(row); ++near) {
    if (near >= start - 2 && near <= start + 2) {
      lowest = std::min<std::int32_t>(lowest, row[static_cast<std::size_t>(near)]);
    }
  }
  return lowest;
}

// In units of 2^-24 mm, times the length of a bin: below 2^62.
std::int64_t over_lowest(const Beams& beams, const Surface::Row& row, std::size_t layer,
                         std::int64_t along_mm, std::int32_t limit_mm) {
  const std::int64_t length = beams.bins().length_mm();
  const std::int64_t bin = std::min<std::int64_t>(along_mm / length, 63);
  const std::int64_t start = lowest_of(row, bin);
  const std::int64_t rise = lowest_of(row, bin + 1) - start;
  return (beams.origin_mm() - start - limit_mm) * length * (1 << 24) +
         std::int64_t{beams.slope(layer)} * along_mm * length -
         rise * (along_mm - bin * length) * (1 << 24);
}

void expect_exact(const vehicle::Sensor& sensor, std::int32_t low_mm, std::uint64_t seed) {
  Random random(seed);
  const Beams beams(sensor);
  const Surface surface = rough_surface(random);
  const auto low_beams = std::make_unique<LowBeams>();
  low_beams->find(beams, sensor, low_mm, surface);
  const bool comes_down = beams.origin_mm() > low_mm;
  for (std::uint32_t sector = 0; sector < kSectors;
       sector += static_cast<std::uint32_t>(tests::effort(17, 51))) {
    for (const std::uint8_t layer : beams.from_below()) {
      std::int64_t expected = -2;
      while (expected + 2 <= beams.range_mm()) {
        const std::int64_t over =
            over_lowest(beams, surface.row(sector), layer, expected + 2, low_mm);
        if (comes_down ? over < 0 : over > 0) {
          break;
        }
        expected += 2;
      }
      ASSERT_EQ(low_beams->border_mm(sector, layer), std::max<std::int64_t>(expected, 0))
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
  const auto low_beams = std::make_unique<LowBeams>();
  low_beams->find(beams, sensor, 600, surface);
  const std::uint32_t steps = sensor.azimuths.steps_per_turn() / kSectors;
  int come_down = 0;
  for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
    const auto direction = vehicle::direction_of(sensor, sector * steps + steps / 2);
    for (const std::uint8_t layer : beams.from_below()) {
      const Slope rise = beams.slope_to(vehicle::end_height_of(sensor.layers[layer], direction));
      const auto over_low = [&](std::uint32_t along_mm) {
        const std::uint32_t out_mm = beams.out_mm(layer, along_mm);
        const std::int64_t length = beams.bins().length_mm();
        const std::int64_t bin = std::min<std::int64_t>(out_mm / length, 63);
        const double start = lowest_of(surface.row(sector), bin);
        const double to_end = lowest_of(surface.row(sector), bin + 1) - start;
        const double part = static_cast<double>(out_mm) / static_cast<double>(length);
        return beams.height_mm(rise, along_mm) - start -
               to_end * (part - static_cast<double>(bin)) - 600;
      };
      const std::uint32_t border_mm = low_beams->border_mm(sector, layer);
      for (std::uint32_t along_mm = 0; along_mm + 4 < border_mm; along_mm += 128) {
        ASSERT_GE(over_low(along_mm), -2) << sector << ", " << int{layer} << ", " << along_mm;
      }
      if (border_mm + 4 < beams.range_mm() &&
          beams.out_mm(layer, border_mm) < kBins * beams.bins().length_mm()) {
        ASSERT_LE(over_low(border_mm + 6), 20) << sector << ", " << int{layer};
        ++come_down;
      }
    }
  }
  EXPECT_GT(come_down, 500);
}

}  // namespace
}  // namespace iog::ground
