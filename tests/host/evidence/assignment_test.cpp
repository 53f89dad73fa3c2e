// What an occupancy index is worth, against the formulas.
#include "evidence/assignment.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "evidence/cell.hpp"

namespace iog::evidence {
namespace {

constexpr Gains kSomeGains{.free_mass = 12'345, .hit_mass = 23'456};

// Every index that a cell can hold; that of 0 is no evidence.
template <typename Check>
void for_each_index(Check&& check) {
  for (int n = -127; n <= 127; ++n) {
    check(n, static_cast<index::OccupancyIndex>(n));
  }
}

// In a description without a table every hit has one mass, and time grades free.
TEST(Evidence, HasTheSignOfItsIndex) {
  for_each_index([](int n, index::OccupancyIndex index) {
    const Evidence evidence = evidence_of(index, kSomeGains);
    ASSERT_EQ(evidence.occupied, n > 0 ? 23'456 : 0) << n;
    ASSERT_EQ(evidence.free, n < 0 ? 12'345 : 0) << n;
  });
}

// 0.87 in steps of 1/128, down: 111.36.
TEST(Evidence, OfAHitIsWorthNearly87Percent) { EXPECT_EQ(Gains{}.hit_mass, 28'416); }

// Kurdej 2015, section 4.5.2.2: k echoes are worth 1 - (1 - 0.8)^k = 1 - 1 / 5^k. In exact integers
// down to steps of 1/128; from k = 4 on all is certain but for less than one step.
TEST(Reinforced, IsWorthMoreByEveryEcho) {
  for_each_index([](int n, index::OccupancyIndex index) {
    const Evidence evidence = evidence_of(index, kSomeGains, kReinforced);
    std::int64_t fives = 1;
    for (int echo = 0; echo < std::min((n + 1) / 2, 10); ++echo) {
      fives *= 5;
    }
    ASSERT_EQ(evidence.occupied, n > 0 ? 128 * (fives - 1) / fives * 256 : 0) << n;
    ASSERT_EQ(evidence.free, n < 0 ? 12'345 : 0) << n;
  });
}

// 2 p_n - 1 = (r^n - 1) / (r^n + 1) with r = (1/2 + eps) / (1/2 - eps), a hyperbolic tangent.
void expect_isopignistic(const Assignment& assignment, double epsilon) {
  for_each_index([&](int n, index::OccupancyIndex index) {
    const double log_odds = n * std::log((0.5 + epsilon) / (0.5 - epsilon));
    const double mass = std::min(std::abs(std::tanh(log_odds / 2)), 0.95);
    const auto expected = static_cast<int>(std::floor(128 * mass)) * 256;
    const Evidence evidence = evidence_of(index, kSomeGains, assignment);
    ASSERT_EQ(evidence.occupied, n > 0 ? expected : 0) << n;
    ASSERT_EQ(evidence.free, n < 0 ? expected : 0) << n;
  });
}

TEST(Isopignistic, HasTheProbabilityOfItsIndex) {
  expect_isopignistic(kIsopignistic, 0.05);
  expect_isopignistic(make_isopignistic(0.1), 0.1);
}

// Of a hit of +2 and a beam of -14, the beam says four times as much: why it is not the default.
TEST(Isopignistic, MakesAHitWeak) {
  EXPECT_EQ(evidence_of(2, kSomeGains, kIsopignistic).occupied, 25 * 256);
  EXPECT_EQ(evidence_of(-14, kSomeGains, kIsopignistic).free, 113 * 256);
}

}  // namespace
}  // namespace iog::evidence
