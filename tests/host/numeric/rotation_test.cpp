// Sine and cosine of a binary angle against the C library.
#include "numeric/rotation.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::numeric {
namespace {

using Real = long double;

constexpr Real kFullTurn = 2 * 3.14159265358979323846264338327950288L;

Real error_of(std::uint32_t angle) {
  const Real exact = std::sin(static_cast<Real>(angle) * kFullTurn / 4'294'967'296.0L);
  return std::fabs(std::ldexp(static_cast<Real>(sine_of(angle)), -kSineFractionBits) - exact);
}

// 2^-21, at every place of the table and at its worst places, halfway between.
TEST(Rotation, SineIsWithinItsBound) {
  const Real most = std::ldexp(1.0L, -21);
  for (std::uint64_t angle = 0; angle < 0x1'0000'0000; angle += 0x8'0000) {
    ASSERT_LT(error_of(static_cast<std::uint32_t>(angle)), most) << angle;
  }
  tests::Random random(7);
  for (int i = 0; i < 20'000; ++i) {
    const auto angle = static_cast<std::uint32_t>(random.next());
    ASSERT_LT(error_of(angle), most) << angle;
  }
}

// docs/spec.md 5.4: the sine of 4096 angles, each to the nearest 2^-30, and the line between two of
// them to the nearest, a half up.
TEST(Rotation, SineIsTheLineBetweenTwoOfTheTable) {
  const auto table = [](std::uint32_t tick) -> std::int64_t {
    const Real exact = std::sin(static_cast<Real>(tick) * kFullTurn / 4096);
    return std::llround(std::ldexp(exact, 30));
  };
  constexpr std::int64_t kSteps = 1 << 20;
  tests::Random random(9);
  for (int i = 0; i < 20'000; ++i) {
    const auto angle = static_cast<std::uint32_t>(random.next());
    const std::int64_t here = table(angle >> 20);
    const std::int64_t risen = (table((angle >> 20) + 1) - here) * (angle % kSteps);
    // The largest integer that is at most half above.
    const std::int64_t twice_off = 2 * ((sine_of(angle) - here) * kSteps - risen);
    ASSERT_GT(twice_off, -kSteps) << angle;
    ASSERT_LE(twice_off, kSteps) << angle;
  }
}

TEST(Rotation, QuartersOfATurnAreExact) {
  constexpr std::int32_t kOne = 1 << 30;
  EXPECT_EQ(sine_of(0), 0);
  EXPECT_EQ(sine_of(0x40000000), kOne);
  EXPECT_EQ(sine_of(0x80000000), 0);
  EXPECT_EQ(sine_of(0xC0000000), -kOne);
  EXPECT_EQ(rotation_of(0).cos_q30, kOne);
  EXPECT_EQ(rotation_of(0x80000000).cos_q30, -kOne);
}

TEST(Rotation, CosineIsTheSineAQuarterAhead) {
  tests::Random random(8);
  for (int i = 0; i < 1'000; ++i) {
    const auto angle = static_cast<std::uint32_t>(random.next());
    const Rotation rotation = rotation_of(angle);
    const Real exact = std::cos(static_cast<Real>(angle) * kFullTurn / 4'294'967'296.0L);
    ASSERT_NEAR(static_cast<double>(rotation.cos_q30), static_cast<double>(std::ldexp(exact, 30)),
                512);
    ASSERT_EQ(rotation.sin_q30, sine_of(angle));
  }
}

// So a heading that turns evenly never seems to turn back.
TEST(Rotation, SineRisesWhereItRises) {
  std::int32_t before = sine_of(0xC0000000);
  for (std::uint32_t step = 1; step <= 1U << 18; ++step) {
    const std::int32_t here = sine_of(0xC0000000 + (step << 13));
    ASSERT_GE(here, before) << step;
    before = here;
  }
}

}  // namespace
}  // namespace iog::numeric
