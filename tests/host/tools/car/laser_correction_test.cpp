// docs/spec.md 1.2 and 1.2.1: a laser's own azimuth is rounded to the nearest tick, a tie away
// from 0.
#include <array>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

#include "gtest/gtest.h"

#include "tools/car/tables.hpp"

namespace iog::description {
namespace {

constexpr std::int32_t kHundredths = 36'000;
constexpr std::int32_t kOusterTicks = 46'080;

int ticks_of(double azimuth_deg, std::int32_t ticks_per_turn) {
  return correction_of({.azimuth_deg = azimuth_deg}, ticks_per_turn).azimuth_ticks;
}

// As a maker's file or a car's file has it: no double is 0.015.
double written(int thousandths_deg) {
  std::array<char, 16> text{};
  const int size = std::abs(thousandths_deg);
  static_cast<void>(std::snprintf(text.data(), text.size(), "%s%d.%03d",
                                  thousandths_deg < 0 ? "-" : "", size / 1000, size % 1000));
  return std::strtod(text.data(), nullptr);
}

TEST(LaserCorrection, EachThousandthOfADegreeIsRoundedByTheRule) {
  for (int thousandths = 0; thousandths <= 30'000; ++thousandths) {
    const int hundredths = (thousandths + 5) / 10;
    ASSERT_EQ(ticks_of(written(thousandths), kHundredths), hundredths) << thousandths;
    ASSERT_EQ(ticks_of(written(-thousandths), kHundredths), -hundredths) << thousandths;
  }
}

// Pandar64 User Manual, appendix "Channel distribution": horizontal offsets of 1.042, 3.125 and
// 5.208 degrees.
TEST(LaserCorrection, TheTieOfAPandar64IsAwayFromZero) {
  EXPECT_EQ(ticks_of(3.125, kHundredths), 313);
  EXPECT_EQ(ticks_of(-3.125, kHundredths), -313);
  EXPECT_EQ(ticks_of(1.042, kHundredths), 104);
  EXPECT_EQ(ticks_of(-5.208, kHundredths), -521);
}

// A degree is 128 ticks, so that a tie is an odd 256th part.
TEST(LaserCorrection, TiesOfAnOusterAreAwayFromZero) {
  for (int halves = 1; halves < 30 * 256; halves += 2) {
    ASSERT_EQ(ticks_of(halves / 256.0, kOusterTicks), (halves + 1) / 2);
    ASSERT_EQ(ticks_of(-halves / 256.0, kOusterTicks), -(halves + 1) / 2);
  }
}

}  // namespace
}  // namespace iog::description
