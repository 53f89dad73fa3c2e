// What a 1D cell is worth: thesis tables 4.3 and figure 4.6.
#include "lab/evidence/values.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "sensor_model/profile.hpp"

namespace iog::lab {
namespace {

template <typename Value>
Value at(const ByStep<Value>& values, int step) {
  return values[slot_of(step)];
}

// Table 4.3, and below k - 2 the floor of section 4.3.1.1.
TEST(Values, ProbabilitiesAreThoseOfTable43) {
  const auto values = probabilities({});
  for (int step = -kFarSteps; step <= -3; ++step) {
    EXPECT_EQ(at(values, step), 0.05);
  }
  EXPECT_NEAR(at(values, -2), 0.185, 0.0005);
  EXPECT_NEAR(at(values, -1), 0.480, 0.0005);
  EXPECT_NEAR(at(values, 0), 0.604, 0.0005);
  EXPECT_NEAR(at(values, 1), 0.542, 0.0005);
  EXPECT_NEAR(at(values, 2), 0.505, 0.0005);
  EXPECT_NEAR(at(values, kFarSteps), 0.5, 1e-15);
}

// The first cells are so certainly empty that only the floor holds them up.
TEST(Values, WithoutAFloorTheFirstCellsAreAlmostSurelyFree) {
  const auto values = probabilities({.floor = 0});
  EXPECT_LT(at(values, -kFarSteps), 0.001);
  EXPECT_GT(at(values, -kFarSteps), 0);
}

// The reference in double precision and the tables that the firmware's compiler makes agree in
// every cell, for cells shorter and longer than sigma.
TEST(Values, IndexesAreTheFirmwaresProfile) {
  constexpr auto kShort = sensor_model::make_profile({.sigma_m = 0.1, .cell_length_m = 0.08});
  constexpr auto kLong = sensor_model::make_profile({.sigma_m = 0.1, .cell_length_m = 0.2});
  const auto of_short =
      indexes(probabilities({.cell_length_m = 0.08}), 0.05, index::Quantisation::kBlurring);
  const auto of_long =
      indexes(probabilities({.cell_length_m = 0.2}), 0.05, index::Quantisation::kBlurring);
  for (int step = -kFarSteps; step <= kFarSteps; ++step) {
    EXPECT_EQ(at(of_short, step), kShort.at(step)) << step;
    EXPECT_EQ(at(of_long, step), kLong.at(step)) << step;
  }
}

// The log-odds of p_1 are 4 epsilon up to terms of its third power, so that the floor's index is
// log(19) / (4 epsilon).
TEST(Values, TheFreeIndexGrowsAsEpsilonFalls) {
  for (const double epsilon : {1e-2, 1e-3, 1e-4, 1e-5, 1e-6}) {
    const auto values = indexes(probabilities({}), epsilon, index::Quantisation::kNearest);
    const double expected = -std::log(19.0) / (4 * epsilon);
    EXPECT_NEAR(at(values, -kFarSteps), expected, 1 + std::abs(expected) * epsilon);
    EXPECT_EQ(at(values, kFarSteps), 0);
  }
}

// Half a step of the set to either side at most, blurring a whole one towards 1/2.
TEST(Values, AnIndexStandsForItsProbabilityToWithinEpsilon) {
  const auto exact = probabilities({});
  for (const double epsilon : {0.1, 0.05, 1e-2, 1e-4, 1e-6}) {
    const index::RecursiveSet set(epsilon);
    const auto blurring = indexes(exact, epsilon, index::Quantisation::kBlurring);
    const auto nearest = indexes(exact, epsilon, index::Quantisation::kNearest);
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double blurred = set.probability(blurring[i]);
      EXPECT_LE(std::abs(blurred - exact[i]), epsilon);
      EXPECT_LE(std::abs(blurred - 0.5), std::abs(exact[i] - 0.5) + 1e-12);
      EXPECT_LE(std::abs(set.probability(nearest[i]) - exact[i]), epsilon / 2 + 1e-12);
    }
  }
}

}  // namespace
}  // namespace iog::lab
