// The angle of a direction against the C library.
#include "numeric/arctangent.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::numeric {
namespace {

// In steps of 2^-16 turns, -2^15 ... 2^15.
double error_of(std::int32_t x, std::int32_t y) {
  constexpr double kTurn = 65536;
  const double exact = std::atan2(static_cast<double>(y), static_cast<double>(x)) * kTurn /
                       (2 * 3.14159265358979323846);
  return std::remainder(angle_of(x, y) - exact, kTurn);
}

TEST(Arctangent, AxesAndDiagonalsAreExact) {
  EXPECT_EQ(angle_of(1, 0), 0);
  EXPECT_EQ(angle_of(16384, 16384), 0x2000);
  EXPECT_EQ(angle_of(0, 1), 0x4000);
  EXPECT_EQ(angle_of(-3, 3), 0x6000);
  EXPECT_EQ(angle_of(-INT32_MAX, 0), 0x8000);
  EXPECT_EQ(angle_of(-7, -7), 0xA000);
  EXPECT_EQ(angle_of(0, -INT32_MAX), 0xC000);
  EXPECT_EQ(angle_of(5, -5), 0xE000);
  EXPECT_EQ(angle_of(0, 0), 0);
}

// Just below a turn is 0 again, and just below a quarter is one.
TEST(Arctangent, IsRoundedToTheNearest) {
  EXPECT_EQ(angle_of(1'000'000, -1), 0);
  EXPECT_EQ(angle_of(1, 1'000'000), 0x4000);
  EXPECT_EQ(angle_of(-1, -1'000'000), 0xC000);
  EXPECT_EQ(angle_of(1'000'000, -72), 65535);  // 0.75 of a step
}

// Every direction that a box may have, and long ones.
TEST(Arctangent, IsWithinItsBound) {
  constexpr double kMost = 0.505;
  for (int step = 0; step < 65536; ++step) {
    const double angle = step * 2 * 3.14159265358979323846 / 65536;
    const auto x = static_cast<std::int32_t>(std::round(16384 * std::cos(angle)));
    const auto y = static_cast<std::int32_t>(std::round(16384 * std::sin(angle)));
    ASSERT_LE(std::abs(error_of(x, y)), kMost) << x << ' ' << y;
  }
  tests::Random random(3);
  for (int i = 0; i < 20'000; ++i) {
    const int shift = static_cast<int>(random.below(31));
    const std::int32_t x = static_cast<std::int32_t>(random.next()) >> shift;
    const std::int32_t y = static_cast<std::int32_t>(random.next()) >> random.below(31);
    if (x != INT32_MIN && y != INT32_MIN && (x != 0 || y != 0)) {
      ASSERT_LE(std::abs(error_of(x, y)), kMost) << x << ' ' << y;
    }
  }
}

}  // namespace
}  // namespace iog::numeric
