// The compiler's exp, log, sin and cos against the C library's.
#include "numeric/elementary.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "numeric/sine_table.hpp"

namespace iog::numeric {
namespace {

constexpr double kRelative = 1e-14;

TEST(Elementary, PowersOfTwoAreExact) {
  for (int n = -1022; n <= 1022; ++n) {
    ASSERT_EQ(power_of_two(n), std::ldexp(1.0, n));
  }
}

TEST(Elementary, ExpIsThatOfTheCLibrary) {
  for (double x = -690; x < 690; x += 0.37) {
    EXPECT_NEAR(exp(x) / std::exp(x), 1, 300 * kRelative) << x;
  }
  for (double x = -3; x < 3; x += 0.01) {
    EXPECT_NEAR(exp(x) / std::exp(x), 1, kRelative) << x;
  }
}

TEST(Elementary, LogIsThatOfTheCLibrary) {
  for (double x = 1e-12; x < 1e12; x *= 1.07) {
    EXPECT_NEAR(log(x), std::log(x), kRelative * (1 + std::fabs(std::log(x)))) << x;
  }
}

TEST(Elementary, SineAndCosineAreThoseOfTheCLibrary) {
  for (double x = -12; x < 12; x += 0.001) {
    EXPECT_NEAR(sin(x), std::sin(x), 1e-14) << x;
    EXPECT_NEAR(cos(x), std::cos(x), 1e-14) << x;
  }
}

TEST(Elementary, RoundGoesToTheNearestAndTiesAwayFromZero) {
  EXPECT_EQ(round(2.5), 3);
  EXPECT_EQ(round(-2.5), -3);
  EXPECT_EQ(round(2.49), 2);
  EXPECT_EQ(round(-0.2), 0);
}

template <int kTicks>
void expect_whole_turn() {
  const SineTable table = kSineTable<kTicks>;
  const double unit = std::ldexp(1.0, kSineFractionBits);
  ASSERT_EQ(table.ticks_per_turn(), static_cast<std::uint32_t>(kTicks));
  for (std::uint32_t tick = 0; tick < static_cast<std::uint32_t>(kTicks); ++tick) {
    const double angle = 2 * kPi * tick / kTicks;
    ASSERT_NEAR(table.sine(tick), std::sin(angle) * unit, 0.5001) << tick;
    ASSERT_NEAR(table.cosine(tick), std::cos(angle) * unit, 0.5001) << tick;
  }
}

TEST(SineTable, EveryTickOfALuxIsTheNearestInteger) { expect_whole_turn<11520>(); }
TEST(SineTable, EveryTickOfAVelodyneIsTheNearestInteger) { expect_whole_turn<36000>(); }

}  // namespace
}  // namespace iog::numeric
