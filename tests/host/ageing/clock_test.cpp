// Stamps to times: floors, slots in turn, and a time that does not go back.
#include "ageing/clock.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/random.hpp"

namespace iog::ageing {
namespace {

constexpr std::uint64_t kMs = 1000;

TEST(Clock, KnowsNothingBeforeTheFirstFrame) {
  const Clock clock;
  EXPECT_EQ(clock.now(), Clock::kNever);
  for (std::uint8_t slot = 0; slot <= Clock::kFrames; ++slot) {
    EXPECT_EQ(clock.ms_since(slot), Clock::kEver);
    EXPECT_EQ(clock.since(slot), evidence::kForgotten);
    EXPECT_EQ(clock.gains(slot), gains_after(100, kGainsByTime));
  }
}

TEST(Clock, LeavesEverythingInTheFirstFrame) {
  Clock clock;
  clock.advance(1'700'000'000'000'000);
  EXPECT_EQ(clock.now(), 1);
  EXPECT_EQ(clock.ms_since(1), 0);
  EXPECT_EQ(clock.since(1), evidence::Fading{});
  EXPECT_EQ(clock.ms_since(Clock::kNever), Clock::kEver);
  EXPECT_EQ(clock.since(Clock::kNever), evidence::kForgotten);
  EXPECT_EQ(clock.gains(Clock::kNever), gains_after(100, kGainsByTime));
}

// 40.9 ms are 40 and 41 in turn, so that 1000 frames are 40.9 s and not 40.
TEST(Clock, TakesDifferencesOfFloors) {
  Clock clock;
  std::uint64_t elapsed = 0;
  clock.advance(0);
  for (std::uint64_t frame = 1; frame <= 1000; ++frame) {
    const std::uint8_t before = clock.now();
    clock.advance(frame * 40'900);
    ASSERT_EQ(clock.ms_since(before), frame * 40'900 / kMs - (frame - 1) * 40'900 / kMs);
    elapsed += clock.ms_since(before);
  }
  EXPECT_EQ(elapsed, 40'900);
}

TEST(Clock, CountsTheStampsMillisecondAndNotTheTimeBetween) {
  Clock clock;
  clock.advance(1999);
  clock.advance(2000);
  EXPECT_EQ(clock.ms_since(1), 1);
  clock.advance(2999);
  EXPECT_EQ(clock.ms_since(2), 0);
}

TEST(Clock, TakesAnOlderStampForTheSame) {
  Clock clock;
  clock.advance(100 * kMs);
  clock.advance(60 * kMs);
  EXPECT_EQ(clock.ms_since(1), 0);
  EXPECT_EQ(clock.since(1), evidence::Fading{});
  clock.advance(103 * kMs);
  EXPECT_EQ(clock.ms_since(1), 3);
  EXPECT_EQ(clock.ms_since(2), 3);
}

// Every slot against the list of all stamps, far beyond one turn of the ring.
TEST(Clock, RemembersTheNewest64Frames) {
  tests::Random random(40);
  for (const Discounting discounting : {Discounting::kConservative, Discounting::kProportional}) {
    Clock clock(discounting);
    std::vector<std::uint64_t> stamps_ms;
    std::uint64_t stamp_us = 5'000'000;
    for (std::size_t frame = 0; frame < 300; ++frame) {
      stamp_us +=
          static_cast<std::uint64_t>(random.between(0, random.one_in(20) ? 2'000'000 : 90'000));
      clock.advance(stamp_us);
      stamps_ms.push_back(stamp_us / kMs);
      ASSERT_EQ(clock.now(), frame % 64 + 1);
      for (std::size_t age = 0; age < std::min<std::size_t>(64, stamps_ms.size()); ++age) {
        const auto slot = static_cast<std::uint8_t>((frame - age) % 64 + 1);
        const auto ms = static_cast<std::uint32_t>(stamps_ms[frame] - stamps_ms[frame - age]);
        ASSERT_EQ(clock.ms_since(slot), ms);
        ASSERT_EQ(clock.since(slot), left_after(ms, discounting));
        ASSERT_EQ(clock.gains(slot), gains_after(ms, kGainsByTime));
      }
    }
  }
}

TEST(Clock, ForgetsOverALongPause) {
  Clock clock(Discounting::kOptimistic);
  clock.advance(0);
  clock.advance(65'535 * kMs);
  EXPECT_EQ(clock.since(1).occupied, evidence::kWhole);
  clock.advance(65'536 * kMs);
  EXPECT_EQ(clock.since(1), evidence::kForgotten);
  clock.advance(0xFFFF'FFFF'FFFF'FFFF);
  EXPECT_EQ(clock.ms_since(1), Clock::kEver);
  EXPECT_EQ(clock.since(3), evidence::kForgotten);
  EXPECT_EQ(clock.since(4), evidence::Fading{});
}

TEST(Clock, WeighsAsItIsTold) {
  Clock clock(Discounting::kConservative, Weighing::kEachScan);
  clock.advance(0);
  EXPECT_EQ(clock.gains(1), gains_after(0, kGainsOfScan));
}

}  // namespace
}  // namespace iog::ageing
