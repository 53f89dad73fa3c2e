// Heights over a surface whose rows are written by hand, and how long a row is kept.
#include "ground/surface.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "fakes/reference_ground.hpp"

namespace iog::ground {
namespace {

using tests::Random;

TEST(Surface, IsTheCarsPlaneBeforeTheFirstTurn) {
  const Surface surface;
  const Bins bins(50'000);
  EXPECT_EQ(surface.count(Surface::Source::kFlat), kSectors);
  for (const std::uint32_t along : {0U, 1U, 65'535U, 65'536U, (1U << 20) - 1}) {
    EXPECT_EQ(surface.height_over(bins, 17, along, 250), 250);
  }
}

// As if each start were as high as the highest one from two bins before to two behind: on stairs in
// both directions, at the row's ends and behind them, in rational numbers.
TEST(Surface, IsAsHighAsTheHighestGroundNearby) {
  Random random(6);
  for (const Bins bins : {Bins(50'000), Bins(120'000)}) {
    const tests::Whole length = bins.length_mm();
    for (int i = 0; i < 20'000; ++i) {
      Surface surface;
      const auto sector = static_cast<std::uint32_t>(random.below(kSectors));
      Surface::Row& row = surface.renew(sector);
      for (std::int16_t& start : row) {
        start = static_cast<std::int16_t>(random.between(-14'000, 14'000));
      }
      const auto highest = [&](tests::Whole start) {
        tests::Whole most = -32'000;
        for (tests::Whole near = std::max<tests::Whole>(start - 2, 0);
             near <= std::min<tests::Whole>(start + 2, 64); ++near) {
          most = std::max<tests::Whole>(most, row[static_cast<std::size_t>(near)]);
        }
        return most;
      };
      const std::int32_t along = random.between(0, random.one_in(4) ? (1 << 20) - 1 : 130'000);
      const std::int32_t z = random.between(-(1 << 20), 1 << 20);
      const tests::Whole bin = std::min<tests::Whole>(along / length, 63);
      const tests::Whole part = std::min<tests::Whole>(along - bin * length, 16'384);
      const tests::Whole start = highest(bin);
      const tests::Whole rise = highest(bin + 1) - start;
      ASSERT_EQ(surface.height_over_near(bins, sector, static_cast<std::uint32_t>(along), z),
                z - start - tests::floor_of(rise * part, length));
    }
  }
}

// Also at the row's ends.
TEST(Surface, SaysHowLowTheLowestGroundNearbyIs) {
  Surface surface;
  Surface::Row& row = surface.renew(7);
  row.fill(100);
  row[0] = -30;
  row[10] = -500;
  row[12] = -200;
  row[64] = 40;
  const Surface::Row lowest = surface.lowest_near(7);
  for (std::size_t start = 0; start < Surface::kStarts; ++start) {
    const int expected = start <= 2                   ? -30
                         : start >= 8 && start <= 12  ? -500
                         : start == 13 || start == 14 ? -200
                         : start >= 62                ? 40
                                                      : 100;
    EXPECT_EQ(lowest[start], expected) << start;
  }
  EXPECT_EQ(surface.row(7)[11], 100);
}

// An even slope is as low as it is, up or down; a step on it shows, and where a slope begins it is
// level. In rises of 60 mm a bin.
TEST(Surface, ASlopeThatGoesOnIsNoLowerThanItIs) {
  Surface surface;
  for (const int sign : {1, -1}) {
    Surface::Row& row = surface.renew(9);
    for (std::size_t start = 0; start < Surface::kStarts; ++start) {
      const int bins = static_cast<int>(std::max<std::size_t>(start, 20)) - 20;
      row[start] = static_cast<std::int16_t>(sign * 60 * bins - (start == 40 ? 25 : 0));
    }
    const Surface::Row lowest = surface.lowest_near(9);
    const auto near = [&](std::size_t start) {
      return lowest[start] - sign * 60 * (static_cast<int>(start) - 20);
    };
    EXPECT_EQ(lowest[18], 0);
    for (const std::size_t start : {26U, 30U, 37U, 50U, 58U}) {
      EXPECT_EQ(near(start), 0) << start << ", " << sign;
    }
    for (std::size_t start = 38; start <= 42; ++start) {
      EXPECT_EQ(near(start), -25) << start << ", " << sign;
    }
    // Of six bins before and behind one is level.
    EXPECT_EQ(lowest[20], sign > 0 ? 0 : -120);
  }
}

// From one start of a bin to the next, rounded down, and on behind the last one for 16.4 m: in
// rational numbers.
TEST(Surface, IsStraightBetweenTheStartsOfBins) {
  Random random(5);
  for (const Bins bins : {Bins(50'000), Bins(120'000)}) {
    const tests::Whole length = bins.length_mm();
    for (int i = 0; i < 20'000; ++i) {
      Surface surface;
      const auto sector = static_cast<std::uint32_t>(random.below(kSectors));
      Surface::Row& row = surface.renew(sector);
      const bool is_extreme = random.one_in(3);
      for (std::int16_t& start : row) {
        start = static_cast<std::int16_t>(is_extreme ? (random.one_in(2) ? 32'000 : -32'000)
                                                     : random.between(-14'000, 14'000));
      }
      const std::int32_t most = random.one_in(4) ? (1 << 20) - 1 : 130'000;
      const std::int32_t along = random.between(0, most);
      const std::int32_t z = random.between(-(1 << 20), 1 << 20);
      const tests::Whole bin = std::min<tests::Whole>(along / length, 63);
      const tests::Whole part = std::min<tests::Whole>(along - bin * length, 16'384);
      const tests::Whole start = row[static_cast<std::size_t>(bin)];
      const tests::Whole rise = row[static_cast<std::size_t>(bin) + 1] - start;
      ASSERT_EQ(surface.height_over(bins, sector, static_cast<std::uint32_t>(along), z),
                z - start - tests::floor_of(rise * part, length));
      ASSERT_EQ(
          surface.height_over(bins, (sector + 1) % kSectors, static_cast<std::uint32_t>(along), z),
          z);
    }
  }
}

TEST(Surface, KeepsARowForTenTurns) {
  Surface surface;
  surface.renew(7).fill(100);
  surface.renew(8).fill(200);
  for (int turn = 1; turn <= 10; ++turn) {
    surface.keep(7);
    EXPECT_EQ(surface.source(7), Surface::Source::kKept);
    EXPECT_EQ(surface.row(7).front(), 100);
  }
  EXPECT_EQ(surface.count(Surface::Source::kKept), 1U);
  surface.keep(7);
  EXPECT_EQ(surface.source(7), Surface::Source::kFlat);
  EXPECT_EQ(surface.row(7), Surface::Row{});
  surface.keep(7);
  EXPECT_EQ(surface.source(7), Surface::Source::kFlat);
  EXPECT_EQ(surface.source(8), Surface::Source::kOwn);
  EXPECT_EQ(surface.row(8).back(), 200);
}

}  // namespace
}  // namespace iog::ground
