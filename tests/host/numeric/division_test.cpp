#include "numeric/division.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"
#include "numeric/reciprocal.hpp"

namespace iog::numeric {
namespace {

// The definition itself: q d <= n < (q + 1) d.
TEST(Division, FloorIsTheLargestIntegerBelow) {
  for (int divisor = 1; divisor <= 12; ++divisor) {
    for (int dividend = -100; dividend <= 100; ++dividend) {
      const int q = div_floor(dividend, divisor);
      EXPECT_LE(q * divisor, dividend);
      EXPECT_GT((q + 1) * divisor, dividend);
    }
  }
}

TEST(Division, NearestPutsTiesUp) {
  EXPECT_EQ(div_nearest(5, 2), 3);
  EXPECT_EQ(div_nearest(-5, 2), -2);
  EXPECT_EQ(div_nearest(7, 3), 2);
  EXPECT_EQ(div_nearest(-7, 3), -2);
}

// Theorem 4.2 of Granlund and Montgomery promises equality for every dividend below 2^31. The
// dividends most likely to break it lie beside multiples of the divisor and at the top.
void expect_exact(std::uint32_t divisor, tests::Random& random) {
  const Reciprocal reciprocal(divisor);
  constexpr std::uint32_t kTop = 0x7FFFFFFF;
  const auto expect_same = [&](std::uint32_t dividend) {
    ASSERT_EQ(reciprocal.divide(dividend), dividend / divisor) << dividend << " / " << divisor;
  };
  const std::uint32_t most = kTop / divisor;
  for (int i = 0; i < 200; ++i) {
    const auto multiple =
        static_cast<std::uint32_t>(random.next() % (std::uint64_t{most} + 1)) * divisor;
    expect_same(multiple);
    expect_same(multiple == 0 ? 0 : multiple - 1);
    expect_same(multiple + divisor - 1 <= kTop ? multiple + divisor - 1 : kTop);
  }
  expect_same(0);
  expect_same(kTop);
  expect_same(most * divisor);
}

TEST(Reciprocal, DividesExactlyByEveryRangeAndPrecision) {
  tests::Random random(1);
  for (std::uint32_t divisor = 1; divisor <= 3000; ++divisor) {
    expect_exact(divisor, random);
  }
  for (const std::uint32_t divisor : {50'000U, 73'000U, 99'999U, 130'000U, 262'143U, 0x7FFFFFFFU}) {
    expect_exact(divisor, random);
  }
}

}  // namespace
}  // namespace iog::numeric
