// Every exit is where exact arithmetic has it: the last of the distances of 0, 2, 4 ... mm up to
// which a beam stays between the limits, asked of each one by one in whole numbers.
#include "ground/exits.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/ground_turns.hpp"
#include "fakes/middle_beam.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "ground/lows.hpp"
#include "ground/surface_walk.hpp"

namespace iog::ground {
namespace {

using tests::Random;

// In units of 2^-24 mm, times the length of a bin: below 2^62.
bool is_between(const Beams& beams, Limits limits, const Surface::Row& row, std::size_t layer,
                std::int64_t along_mm) {
  const std::int64_t length = beams.bins().length_mm();
  const std::int64_t bin = std::min<std::int64_t>(along_mm / length, 63);
  const std::int64_t start = row[static_cast<std::size_t>(bin)];
  const std::int64_t rise = row[static_cast<std::size_t>(bin) + 1] - start;
  const auto fine = [&](std::int64_t mm) { return mm * length * (1 << 24); };
  const std::int64_t over = fine(beams.origin_mm() - start) +
                            std::int64_t{beams.slope(layer)} * along_mm * length -
                            rise * (along_mm - bin * length) * (1 << 24);
  return fine(limits.low_mm) <= over && over <= fine(limits.top_mm);
}

std::uint32_t exact_exit(const Beams& beams, Limits limits, const Surface::Row& row,
                         std::size_t layer) {
  std::uint32_t to = 0;
  if (!is_between(beams, limits, row, layer, 0)) {
    return 0;
  }
  while (to + 2 <= beams.range_mm() && is_between(beams, limits, row, layer, to + 2)) {
    to += 2;
  }
  return to;
}

std::unique_ptr<Exits> exits_of(const vehicle::Sensor& sensor, Limits limits,
                                const Surface& surface) {
  auto its = std::make_unique<Exits>();
  const Beams beams(sensor);
  Fan fan(beams, sensor);
  for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
    fan.turn_to(sector);
    its->find(sector, fan, limits, surface);
  }
  return its;
}

void expect_exact(const vehicle::Sensor& sensor, Limits limits, const Surface& surface,
                  std::size_t every) {
  const Beams beams(sensor);
  const auto exits = exits_of(sensor, limits, surface);
  for (std::uint32_t sector = 0; sector < kSectors; sector += static_cast<std::uint32_t>(every)) {
    for (const std::uint8_t layer : beams.from_below()) {
      ASSERT_EQ(exits->to_mm(sector, layer), exact_exit(beams, limits, surface.row(sector), layer))
          << "sector " << sector << " layer " << int{layer};
    }
  }
}

Surface surface_of(Bins bins, const tests::Turn& turn) {
  Lows lows;
  for (const tests::Return& its : turn) {
    lows.add(bins, static_cast<std::uint32_t>(its.sector), static_cast<std::uint32_t>(its.along_mm),
             its.z_mm);
  }
  Surface surface;
  SurfaceWalk().close_turn(bins, lows, surface);
  return surface;
}

// The sensors stand 1.5 m high; their bins are 1,024 and 2,048 mm long.
const vehicle::Sensor& short_bins() { return tests::HighAndFar::kVehicle.sensors[1]; }
const vehicle::Sensor& long_bins() { return tests::LevelVlp16::kVehicle.sensors[0]; }
Bins bins_of(const vehicle::Sensor& sensor) { return Bins(sensor.range.mm()); }

TEST(Exits, AreWhereExactArithmeticHasThem) {
  Random random(21);
  ASSERT_NE(bins_of(short_bins()).length_mm(), bins_of(long_bins()).length_mm());
  for (const vehicle::Sensor* sensor : {&short_bins(), &long_bins()}) {
    for (int i = 0; i < 3; ++i) {
      const auto length = static_cast<std::int32_t>(bins_of(*sensor).length_mm());
      const Limits limits{random.between(100, 1'000), random.between(1'600, 10'000)};
      expect_exact(*sensor, limits, surface_of(bins_of(*sensor), tests::rough_turn(random, length)),
                   tests::effort(17, 51));
    }
  }
}

// Rows that no turn makes.
TEST(Exits, OfAnyGround) {
  Random random(22);
  for (const vehicle::Sensor* sensor : {&short_bins(), &long_bins()}) {
    Surface surface;
    for (std::size_t sector = 0; sector < kSectors; ++sector) {
      const std::int32_t most = random.one_in(2) ? 32'000 : 300;
      for (std::int16_t& start : surface.renew(sector)) {
        start = static_cast<std::int16_t>(random.between(-most, most));
      }
      if (random.one_in(2)) {
        surface.renew(sector)[0] = 0;
      }
    }
    expect_exact(*sensor, {}, surface, tests::effort(1, 5));
  }
}

// Over the car's plane the sine and the cosine say it: from 1.5 m down to 0.22 m.
TEST(Exits, OverFlatGroundAreThoseOfABand) {
  const auto exits = exits_of(long_bins(), {.low_mm = 220, .top_mm = 2'200}, Surface());
  EXPECT_NEAR(exits->to_mm(0, 0), 1'280 / 0.267949, 2.1);  // 15 degrees down
  EXPECT_NEAR(exits->to_mm(0, 15), 700 / 0.267949, 2.1);   // 15 degrees up
  EXPECT_NEAR(exits->to_mm(99, 1), 700 / 0.017455, 3);     // 1 degree up
}

TEST(Exits, PutLayersInTheirOrder) {
  Random random(23);
  for (int i = 0; i < 5; ++i) {
    const Surface surface = surface_of(bins_of(short_bins()), tests::rough_turn(random, 1024));
    const auto exits = exits_of(short_bins(), {}, surface);
    for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
      std::vector<std::size_t> layers;
      for (std::size_t rank = 0; rank < 16; ++rank) {
        layers.push_back(exits->by_rank(sector, rank));
        if (rank > 0) {
          ASSERT_GE(exits->to_mm(sector, layers[rank - 1]), exits->to_mm(sector, layers[rank]));
        }
      }
      std::ranges::sort(layers);
      ASSERT_EQ(layers.size(), 16U);
      ASSERT_TRUE(std::ranges::adjacent_find(layers) == layers.end());
    }
  }
}

// A tilt of 11 degrees: up to its exit a beam is between the limits, and behind it no longer. A
// foot of the ground's steps may lie between two of the distances asked.
TEST(Exits, OfATiltedSensorFollowTheMiddleOfTheirSector) {
  const Limits limits{.low_mm = 220, .top_mm = 2'200};
  const vehicle::Sensor& sensor = tests::MixedCar::kVehicle.sensors[1];
  ASSERT_FALSE(sensor.layers_share_lines);
  const Beams beams(sensor);
  Random random(24);
  const auto length = static_cast<std::int32_t>(beams.bins().length_mm());
  const Surface surface = surface_of(beams.bins(), tests::rough_turn(random, length));
  const auto exits = exits_of(sensor, limits, surface);
  int below = 0;
  int above = 0;
  for (std::uint32_t sector = 0; sector < kSectors; ++sector) {
    for (const std::uint8_t layer : beams.from_below()) {
      const tests::MiddleBeam beam(beams, sensor, sector, layer);
      const auto over_mm = [&](std::uint32_t along_mm) {
        return beam.height_over_mm(surface.row(sector), along_mm);
      };
      const std::uint32_t exit_mm = exits->to_mm(sector, layer);
      for (std::uint32_t along_mm = 0; along_mm + 4 < exit_mm; along_mm += 128) {
        ASSERT_GE(over_mm(along_mm), limits.low_mm - 2) << sector << ", " << int{layer};
        ASSERT_LE(over_mm(along_mm), limits.top_mm + 2) << sector << ", " << int{layer};
      }
      if (exit_mm + 6 < beams.range_mm() && beam.has_ground_at(exit_mm + 6)) {
        const double behind_mm = over_mm(exit_mm + 6);
        ASSERT_TRUE(behind_mm <= limits.low_mm + 20 || behind_mm >= limits.top_mm - 20)
            << sector << ", " << int{layer} << ", " << exit_mm << ": " << behind_mm;
        ++(behind_mm < 1'000 ? below : above);
      }
    }
  }
  EXPECT_GT(std::min(below, above), 300);
}

}  // namespace
}  // namespace iog::ground
