#include "numeric/polar.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <numbers>

#include "fakes/random.hpp"

namespace iog::numeric {
namespace {

// How far an angle is from one in radians, in turns.
double off(std::uint32_t angle, double radians) {
  const double turns = std::ldexp(static_cast<double>(angle), -32);
  return std::abs(std::remainder(turns - radians / (2 * std::numbers::pi), 1));
}

void expect_polar(std::int32_t x, std::int32_t y, std::int32_t z) {
  const Polar its = polar_of(x, y, z);
  const double most = std::ldexp(1, -21);
  const double flat = std::hypot(x, y);
  ASSERT_LT(std::abs(its.range - std::hypot(x, y, z)), 0.55) << x << ' ' << y << ' ' << z;
  if (std::abs(z) > 57 * flat) {
    return;
  }
  ASSERT_LT(off(its.azimuth, std::atan2(y, x)), most) << x << ' ' << y << ' ' << z;
  ASSERT_LT(off(static_cast<std::uint32_t>(its.elevation), std::atan2(z, flat)), most)
      << x << ' ' << y << ' ' << z;
}

TEST(Polar, IsNearTheTrueOneWhereverAPlaceIs) {
  tests::Random random(1);
  for (int bits = 0; bits <= 20; ++bits) {
    const int far = 1 << bits;
    for (int i = 0; i < 10'000; ++i) {
      const auto any = [&] { return random.one_in(20) ? 0 : random.between(-far, far); };
      expect_polar(any(), any(), any());
    }
    for (const int x : {-far, 0, far}) {
      for (const int y : {-far, 0, far}) {
        for (const int z : {-far, 0, far}) {
          expect_polar(x, y, z);
        }
      }
    }
  }
}

TEST(Polar, OfNothingIsNothing) {
  const Polar nothing = polar_of(0, 0, 0);
  EXPECT_EQ(nothing.azimuth, 0U);
  EXPECT_EQ(nothing.elevation, 0);
  EXPECT_EQ(nothing.range, 0U);
}

}  // namespace
}  // namespace iog::numeric
