// A velocity is told less surely than the filter is of it: docs/objects.md, "Stated".
#include "objects/stated.hpp"

#include <gtest/gtest.h>

namespace iog::objects {
namespace {

constexpr std::uint64_t kBornUs = 5'000'000'000;
constexpr Point kFarAway{100'000, 0};

std::uint32_t stated(std::uint32_t deviation, std::uint64_t age_ms, Point car = kFarAway) {
  Track track;
  track.begin(1, {.at = {0, 0}, .sides = {Interval{0, 4'500}, Interval{0, 1'800}}}, kBornUs);
  return stated_deviation(deviation, track, kBornUs + age_ms * 1'000, car);
}

// 1 + 5 s / age: 6 times after 1 s, twice after 5 s, nearly once after an hour.
TEST(StatedDeviation, IsWiderTheYoungerATrackIs) {
  EXPECT_EQ(stated(500, 250), 10'500U);
  EXPECT_EQ(stated(500, 1'000), 3'000U);
  EXPECT_EQ(stated(500, 5'000), 1'000U);
  EXPECT_EQ(stated(500, 3'600'000), 501U);  // rounded up
}

TEST(StatedDeviation, IsFourTimesAtLeastNearerThanTenMetres) {
  EXPECT_EQ(stated(500, 3'600'000, {9'999, 0}), 2'000U);
  EXPECT_EQ(stated(500, 3'600'000, {10'000, 0}), 501U);
  EXPECT_EQ(stated(500, 250, {9'999, 0}), 10'500U);  // the wider of both
}

// As fast as anything can be, 100 m/s: also at the birth, and of a clock that has gone back.
TEST(StatedDeviation, IsAtMostTheSpeedThatAnythingCanHave) {
  EXPECT_EQ(stated(10'000, 300), 100'000U);
  EXPECT_EQ(stated(10'000, 0), 100'000U);
  Track track;
  track.begin(1, {}, kBornUs);
  EXPECT_EQ(stated_deviation(10'000, track, kBornUs - 1, kFarAway), 100'000U);
}

}  // namespace
}  // namespace iog::objects
