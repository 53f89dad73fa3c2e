// Indexes across a wide beam, against Bayes' rule computed plainly.
#include "sensor_model/arc.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <vector>

namespace iog::sensor_model {
namespace {

// Theorem 6 of the thesis of 1D cell k itself, cell by cell.
double hit_of(double sigma_m, double cell_m) {
  const auto likelihood = [&](int h) {
    return std::exp(-std::pow(h * cell_m / sigma_m, 2) / 2) * std::pow(2.0, -h);
  };
  double before = 0;
  double all = 0;
  for (int h = -60; h <= 60; ++h) {
    before += h < 0 ? likelihood(h) / 2 : 0;
    all += likelihood(h);
  }
  return (before + likelihood(0)) / all;
}

// Of all directions in which the target may be, each with its weight: in this one the target's own
// probability, in every other nothing is known of it.
double probability_at(int cell, double hit) {
  double probability = 0;
  double weights = 0;
  for (int target = -20; target <= 20; ++target) {
    const double weight = std::exp(-target * target / 2.0);
    probability += weight * (target == cell ? hit : 0.5);
    weights += weight;
  }
  return probability / weights;
}

// The largest n with p_n at most the probability, as blurring has it above one half.
int blurred(double probability, double epsilon) {
  const double q = (0.5 - epsilon) / (0.5 + epsilon);
  int n = 0;
  while (1 / (1 + std::pow(q, n + 1)) <= probability) {
    ++n;
  }
  return n;
}

std::vector<int> marks_of(const Arc& arc) {
  return {arc.marks.begin(), arc.marks.begin() + arc.count};
}

TEST(Arc, HasTheIndexesOfBayesRule) {
  for (const double epsilon : {0.01, 0.02, 0.05, 0.1, 0.2}) {
    for (const double cell_m : {0.1, 0.2, 0.3, 0.4, 0.6, 0.8}) {
      const double hit = hit_of(0.2, cell_m);
      std::vector<int> expected;
      for (int a = 0; a < 10 && blurred(probability_at(a, hit), epsilon) > 0; ++a) {
        expected.push_back(blurred(probability_at(a, hit), epsilon));
      }
      const Arc arc = arc_of({.sigma_m = 0.2, .cell_length_m = cell_m, .epsilon = epsilon}, 16);
      EXPECT_EQ(marks_of(arc), expected) << epsilon << ", " << cell_m;
      EXPECT_EQ(arc.is_given(), !expected.empty());
      EXPECT_EQ(arc.is_valid(), !expected.empty());
    }
  }
}

// docs/model.md, section 10: 0.2 m, 1D cells of 0.4 m, epsilon 0.05.
TEST(Arc, OfTheArs548) {
  const Arc arc = arc_of({.sigma_m = 0.2, .cell_length_m = 0.4}, 16);
  EXPECT_NEAR(hit_of(0.2, 0.4), 0.848, 0.0005);
  EXPECT_NEAR(probability_at(0, hit_of(0.2, 0.4)), 0.639, 0.0005);
  EXPECT_NEAR(probability_at(1, hit_of(0.2, 0.4)), 0.584, 0.0005);
  EXPECT_NEAR(probability_at(2, hit_of(0.2, 0.4)), 0.519, 0.0005);
  EXPECT_EQ(marks_of(arc), (std::vector{2, 1}));
}

// docs/model.md, section 11: 0.05 m, 1D cells of 0.1 m, the same quotient as that of the ARS548.
// Bayes' rule by counting: of 100 cells that were as likely occupied as free, 50 hold a thing, of
// which 40 are not heard, and of the free ones nothing is heard, either.
TEST(Arc, OfAnUltrasonicUnit) {
  const ProfileConfig config{.sigma_m = 0.05, .cell_length_m = 0.1};
  EXPECT_EQ(marks_of(arc_of(config, 480)), (std::vector{2, 1}));
  EXPECT_NEAR((1 - kHeard) / (2 - kHeard), 40.0 / (40 + 50), 1e-12);
  // p_-1 is 0.45 and p_-2 is 0.401: the nearer to one half.
  EXPECT_EQ(unheard(config), -1);
}

// However fine the set is, an echo outweighs what was not heard; and where it is coarse, nothing is
// free.
TEST(Arc, AnEchoOutweighsWhatWasNotHeard) {
  for (double epsilon = 0.01; epsilon < 0.4; epsilon += 0.01) {
    const ProfileConfig config{.sigma_m = 0.05, .cell_length_m = 0.1, .epsilon = epsilon};
    const Arc arc = arc_of(config, 480);
    EXPECT_LE(unheard(config), 0) << epsilon;
    if (arc.is_given()) {
      EXPECT_GT(arc.marks[0] + unheard(config), 0) << epsilon;
    }
  }
  EXPECT_EQ(unheard({.sigma_m = 0.05, .cell_length_m = 0.1, .epsilon = 0.06}), 0);
}

TEST(Arc, WhatIsFreeIsNotAboveZero) {
  EXPECT_TRUE((Arc{.cell_ticks = 480, .count = 1, .marks = {2}, .free = -1}.is_valid()));
  EXPECT_FALSE((Arc{.cell_ticks = 480, .count = 1, .marks = {2}, .free = 1}.is_valid()));
}

TEST(Arc, EachDirectionHasTheIndexOfItsCell) {
  for (const int cell_ticks : {3, 16, 17, 32}) {
    const Arc arc{
        .cell_ticks = static_cast<std::uint16_t>(cell_ticks), .count = 3, .marks = {9, 5, 1}};
    for (int off = -arc.reach_ticks(); off <= arc.reach_ticks(); ++off) {
      const int cell = static_cast<int>(std::floor(std::abs(off) / double(cell_ticks) + 0.5));
      ASSERT_EQ(arc.at(off), arc.marks.at(static_cast<std::size_t>(cell))) << off;
    }
    // One tick farther is in the next cell.
    EXPECT_EQ(std::floor((arc.reach_ticks() + 1) / double(cell_ticks) + 0.5), 3);
  }
}

TEST(Arc, IndexesThatRiseOutwardsAreNoArc) {
  EXPECT_TRUE((Arc{.cell_ticks = 16, .count = 2, .marks = {2, 2}}.is_valid()));
  EXPECT_FALSE((Arc{.cell_ticks = 16, .count = 2, .marks = {1, 2}}.is_valid()));
  EXPECT_FALSE((Arc{.cell_ticks = 16, .count = 2, .marks = {2, 0}}.is_valid()));
  EXPECT_FALSE((Arc{.cell_ticks = 0, .count = 1, .marks = {2}}.is_valid()));
  EXPECT_FALSE((Arc{.cell_ticks = 16, .count = 4, .marks = {2, 2, 2}}.is_valid()));
  EXPECT_FALSE(Arc{}.is_valid());
}

}  // namespace
}  // namespace iog::sensor_model
