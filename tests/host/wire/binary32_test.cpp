#include "wire/binary32.hpp"

#include <bit>
#include <cmath>
#include <gtest/gtest.h>
#include <limits>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::wire {
namespace {

std::optional<std::int64_t> nearest(float value, std::uint32_t factor, int fraction_bits) {
  return nearest_product(std::bit_cast<std::uint32_t>(value), factor, fraction_bits);
}

TEST(Binary32, IsRoundedToTheNearestATieAwayFromZero) {
  EXPECT_EQ(nearest(0.0F, 1, 0), 0);
  EXPECT_EQ(nearest(-0.0F, 1, 0), 0);
  EXPECT_EQ(nearest(0.5F, 1, 0), 1);
  EXPECT_EQ(nearest(-0.5F, 1, 0), -1);
  EXPECT_EQ(nearest(0.4999F, 1, 0), 0);
  EXPECT_EQ(nearest(3.0F, 1000, 0), 3000);
  EXPECT_EQ(nearest(3.0F, 3, 1), 5);  // 4.5
  EXPECT_EQ(nearest(1e-44F, 0xFFFF'FFFF, 0), 0);
}

TEST(Binary32, WhatIsNoNumberOrTooLargeIsNone) {
  EXPECT_EQ(nearest(std::numeric_limits<float>::quiet_NaN(), 1, 0), std::nullopt);
  EXPECT_EQ(nearest(std::numeric_limits<float>::infinity(), 1, 0), std::nullopt);
  EXPECT_EQ(nearest(-std::numeric_limits<float>::infinity(), 1, 0), std::nullopt);
  EXPECT_EQ(nearest(std::ldexp(1.0F, 20), 1, 0), std::nullopt);
  EXPECT_EQ(nearest(std::ldexp(1.0F, 19), 0xFFFF'FFFF, 0), std::int64_t{0xFFFF'FFFF} << 19);
  EXPECT_EQ(nearest(std::ldexp(1.0F, 40), 1, 20), std::nullopt);
}

// Factors below 2^29, so that a product is exact in binary64.
TEST(Binary32, IsWhatFloatingPointArithmeticSays) {
  tests::Random random(548);
  for (int i = 0; i < tests::effort(200'000, 5'000); ++i) {
    const auto bits = static_cast<std::uint32_t>(random.next());
    const auto factor = static_cast<std::uint32_t>(random.next()) >> 3;
    const int fraction_bits = random.between(0, 32);
    const auto value = static_cast<double>(std::bit_cast<float>(bits));
    const auto ours = nearest_product(bits, factor, fraction_bits);
    if (!std::isfinite(value) || std::abs(value) >= std::ldexp(1.0, 20 + fraction_bits)) {
      ASSERT_EQ(ours, std::nullopt);
    } else if (std::abs(value) < std::ldexp(1.0, 19 + fraction_bits)) {
      ASSERT_TRUE(ours.has_value());
      ASSERT_EQ(static_cast<double>(*ours), std::round(std::ldexp(value * factor, -fraction_bits)));
    }
  }
}

}  // namespace
}  // namespace iog::wire
