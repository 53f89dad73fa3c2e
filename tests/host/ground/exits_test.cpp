// Every exit is where exact arithmetic has it: the last of the distances of 0, 2, 4 ... mm up to
// which a beam stays between the limits, asked of each one by one in whole numbers.
#include "ground/exits.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/ground_turns.hpp"
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

void expect_exact(const Beams& beams, Limits limits, const Surface& surface, std::size_t every) {
  const auto exits = std::make_unique<Exits>();
  exits->find(beams, limits, surface);
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

// The sensor stands 1.5 m high.
const Beams& short_beams() {
  static const Beams beams(tests::HighAndFar::kVehicle.sensors[1]);
  return beams;
}
const Beams& long_beams() {
  static const Beams beams(tests::LevelVlp16::kVehicle.sensors[0]);
  return beams;
}

TEST(Exits, AreWhereExactArithmeticHasThem) {
  Random random(21);
  ASSERT_NE(short_beams().bins().length_mm(), long_beams().bins().length_mm());
  for (const Beams* beams : {&short_beams(), &long_beams()}) {
    for (int i = 0; i < 3; ++i) {
      const auto length = static_cast<std::int32_t>(beams->bins().length_mm());
      const Limits limits{random.between(100, 1'000), random.between(1'600, 10'000)};
      expect_exact(*beams, limits, surface_of(beams->bins(), tests::rough_turn(random, length)),
                   tests::effort(17, 51));
    }
  }
}

// Rows that no turn makes.
TEST(Exits, OfAnyGround) {
  Random random(22);
  for (const Beams* beams : {&short_beams(), &long_beams()}) {
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
    expect_exact(*beams, {}, surface, tests::effort(1, 5));
  }
}

// Over the car's plane the sine and the cosine say it: from 1.5 m down to 0.22 m.
TEST(Exits, OverFlatGroundAreThoseOfABand) {
  const auto exits = std::make_unique<Exits>();
  exits->find(long_beams(), {.low_mm = 220, .top_mm = 2'200}, Surface());
  EXPECT_NEAR(exits->to_mm(0, 0), 1'280 / 0.267949, 2.1);  // 15 degrees down
  EXPECT_NEAR(exits->to_mm(0, 15), 700 / 0.267949, 2.1);   // 15 degrees up
  EXPECT_NEAR(exits->to_mm(99, 1), 700 / 0.017455, 3);     // 1 degree up
}

TEST(Exits, PutLayersInTheirOrder) {
  Random random(23);
  for (int i = 0; i < 5; ++i) {
    const Surface surface = surface_of(short_beams().bins(), tests::rough_turn(random, 1024));
    const auto exits = std::make_unique<Exits>();
    exits->find(short_beams(), {}, surface);
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

}  // namespace
}  // namespace iog::ground
