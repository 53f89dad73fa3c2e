// Motion against the same formulas in long double.
#include "pose/motion.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::pose {
namespace {

using Real = long double;

constexpr Real kPi = 3.14159265358979323846264338327950288L;
constexpr Real kTurn = 4'294'967'296.0L;  // 2^32

Real radians(std::uint32_t angle) { return static_cast<Real>(angle) * 2 * kPi / kTurn; }

std::uint32_t any_heading(tests::Random& random) {
  return static_cast<std::uint32_t>(random.next());
}

// Anywhere, and every tenth time at the very ends.
Pose any_pose(tests::Random& random) {
  constexpr std::int32_t kEnd = 1'000'000'000;
  const auto coordinate = [&] {
    return random.one_in(10) ? (random.one_in(2) ? kEnd : -kEnd) : random.between(-kEnd, kEnd);
  };
  const std::int32_t x = coordinate();
  return {.x_mm = x, .y_mm = coordinate(), .heading = any_heading(random)};
}

// How far `angle` is off, in units, the short way.
Real angle_off(std::uint32_t angle, Real expected_units) {
  const Real off = std::fmod(static_cast<Real>(angle) - expected_units, kTurn);
  return off > kTurn / 2 ? off - kTurn : off < -kTurn / 2 ? off + kTurn : off;
}

TEST(Moved, IsAsTheFormulaSays) {
  tests::Random random(1);
  for (int i = 0; i < 1'000; ++i) {
    const Pose from = any_pose(random);
    const Motion motion{random.between(-100'000, 100'000), random.between(-10'000'000, 10'000'000)};
    const auto elapsed_us = static_cast<std::uint64_t>(random.between(0, 1'000'000));
    const Real seconds = static_cast<Real>(elapsed_us) / 1e6L;
    const Real turned = static_cast<Real>(motion.yaw_urad_per_s) / 1e6L * seconds;
    const Real length = static_cast<Real>(motion.speed_mm_per_s) * seconds;
    const Real direction = radians(from.heading) + turned / 2;
    const Pose to = moved(from, motion, elapsed_us);
    // Half a millimetre of rounding, 2^-11 mm of the length, 2^-21 of it by the sine, and 10 rad of
    // turning at one part in 10^9.
    const Real most = 0.502L + std::fabs(length) * 5.2e-7L;
    ASSERT_LE(std::fabs(static_cast<Real>(to.x_mm) - from.x_mm - length * std::cos(direction)),
              most);
    ASSERT_LE(std::fabs(static_cast<Real>(to.y_mm) - from.y_mm - length * std::sin(direction)),
              most);
    const Real turned_units = turned / (2 * kPi) * kTurn;
    ASSERT_LE(std::fabs(angle_off(to.heading - from.heading, turned_units)),
              1 + std::fabs(turned_units) * 1e-9L);
  }
}

TEST(Moved, StandsStillWithoutTimeOrSpeed) {
  const Pose pose{1'000'000'000, -1'000'000'000, 0xFFFFFFFF};
  EXPECT_EQ(moved(pose, {100'000, 10'000'000}, 0), pose);
  EXPECT_EQ(moved(pose, {}, 1'000'000), pose);
  EXPECT_EQ(moved({0, 0, 0}, {1'000, 0}, 100'000), (Pose{100, 0, 0}));
  EXPECT_EQ(moved({0, 0, 0x40000000}, {1'000, 0}, 100'000), (Pose{0, 100, 0x40000000}));
}

// q is the nearest integer to part / whole, a tie upwards, in exact arithmetic.
void expect_nearest(std::int64_t q, std::int64_t part, std::int64_t whole) {
  const std::int64_t twice_off = 2 * (q * whole - part);
  ASSERT_GT(twice_off, -whole);
  ASSERT_LE(twice_off, whole);
}

TEST(Between, IsTheNearestIntegerOfTheStraightWay) {
  tests::Random random(3);
  for (int i = 0; i < 1'000; ++i) {
    const Pose from = any_pose(random);
    const Pose to = any_pose(random);
    const std::int32_t span_us =
        random.one_in(2) ? random.between(1, 20) : random.between(8'000, 1'000'000);
    const std::int32_t elapsed_us =
        random.one_in(4) ? span_us * random.between(0, 1) : random.between(0, span_us);
    const Pose pose = between(from, to, static_cast<std::uint64_t>(elapsed_us),
                              static_cast<std::uint64_t>(span_us));
    const auto way = [&](std::int64_t a, std::int64_t b, std::int64_t c) {
      expect_nearest(c - a, (b - a) * elapsed_us, span_us);
    };
    way(from.x_mm, to.x_mm, pose.x_mm);
    way(from.y_mm, to.y_mm, pose.y_mm);
    // The short way round has at most half a turn.
    std::int64_t turn = std::int64_t{to.heading} - from.heading;
    turn = turn >= 0x80000000LL ? turn - 0x100000000LL : turn;
    turn = turn < -0x80000000LL ? turn + 0x100000000LL : turn;
    std::int64_t turned = std::int64_t{pose.heading} - from.heading;
    turned += turn >= 0 && turned < 0 ? 0x100000000LL : 0;
    turned -= turn < 0 && turned > 0 ? 0x100000000LL : 0;
    expect_nearest(turned, turn * elapsed_us, span_us);
  }
}

TEST(Between, TurnsThroughNorthNotRound) {
  const Pose left{0, 0, 0x10000000};
  const Pose right{0, 0, 0xF0000000};
  EXPECT_EQ(between(left, right, 1, 2).heading, 0U);
  EXPECT_EQ(between(right, left, 1, 2).heading, 0U);
  EXPECT_EQ(between(right, left, 3, 4).heading, 0x08000000U);
  EXPECT_EQ(between({0, 0, 0}, {0, 0, 0x80000000}, 1, 2).heading, 0xC0000000U) << "clockwise";
}

TEST(Residual, IsTakenTheShortWayRound) {
  const Residual off = residual({1'000'000'000, -5, 0x00000010}, {-1'000'000'000, 5, 0xFFFFFFF0});
  EXPECT_EQ(off.x_mm, 2'000'000'000);
  EXPECT_EQ(off.y_mm, -10);
  EXPECT_EQ(off.heading, 0x20);
}

// 300 mm, and 6 mrad, which are 300 mm at 50 m.
TEST(Residual, AJumpIsAboveThreeHundredMillimetres) {
  EXPECT_FALSE(is_jump({300, 0, 0}));
  EXPECT_TRUE(is_jump({301, 0, 0}));
  EXPECT_TRUE(is_jump({0, -301, 0}));
  EXPECT_FALSE(is_jump({-180, 240, 0})) << "3, 4, 5";
  EXPECT_TRUE(is_jump({-180, 241, 0}));
  EXPECT_TRUE(is_jump({std::int64_t{1} << 51, 0, 0}));
  const auto limit = static_cast<std::int64_t>(std::floor(0.006L / (2 * kPi) * kTurn));
  EXPECT_FALSE(is_jump({0, 0, limit}));
  EXPECT_TRUE(is_jump({0, 0, limit + 1}));
  EXPECT_FALSE(is_jump({0, 0, -limit}));
  EXPECT_TRUE(is_jump({0, 0, -limit - 1}));
}

}  // namespace
}  // namespace iog::pose
