// Table 4.1 of the thesis: Theorem 6 is Elfes' enumeration. And both against hand-counted grids,
// and the firmware's own code against both.
#include "lab/reference/inverse_sensor_model.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "sensor_model/single_target.hpp"

namespace iog::lab::reference {
namespace {

// One cell: the sensor has seen something, so it is occupied.
TEST(Enumeration, OneCellThatWasSeenIsOccupied) {
  const Estimate estimate = enumerate_configurations({0.7L}, 1);
  EXPECT_EQ(estimate.probability, 1);
  EXPECT_EQ(estimate.terms, 2U);
}

// Two cells of likelihoods a and b, four configurations: nothing 0, (o, e) a, (o, o) a, (e, o) b.
TEST(Enumeration, TwoCellsByHand) {
  const long double a = 0.25L;
  const long double b = 0.5L;
  EXPECT_EQ(enumerate_configurations({a, b}, 1).probability, 0.5);   // 2a / (2a + b)
  EXPECT_EQ(enumerate_configurations({a, b}, 2).probability, 0.75);  // (a + b) / (2a + b)
}

// Three cells, all equally likely to have been seen: 4 of the 7 configurations that show anything
// have cell 1 occupied, and 4 cell 2, and 4 cell 3.
TEST(Enumeration, ASensorThatSaysNothingLeavesWhatSeeingAnythingImplies) {
  for (int i = 1; i <= 3; ++i) {
    EXPECT_NEAR(enumerate_configurations({1, 1, 1}, i).probability, 4.0 / 7, 1e-16);
  }
}

TEST(Enumeration, CostsTwoToTheN) {
  for (int n = 1; n <= 12; ++n) {
    const Likelihoods flat(static_cast<std::size_t>(n), 1);
    EXPECT_EQ(enumerate_configurations(flat, n).terms, 1U << n);
  }
}

TEST(Theorem6, CostsAtMostTwoN) {
  for (int n = 1; n <= 500; n += 7) {
    const Likelihoods flat(static_cast<std::size_t>(n), 1);
    EXPECT_EQ(theorem_6(flat, n).terms, 2U * static_cast<unsigned>(n));
    EXPECT_EQ(theorem_6(flat, 1).terms, static_cast<unsigned>(n) + 1);
  }
}

// z runs over the centres of all cells, and where `share` is not 1/2, over other places in them.
void expect_theorem_6_to_be_the_enumeration(int cells, double share) {
  for (const double sigma_m : {0.02, 0.1, 0.3}) {
    for (const double cell_length_m : {0.025, 0.1, 0.5}) {
      const LocalGrid grid{cells, cell_length_m};
      for (int k = 1; k <= cells; k += cells < 12 ? 1 : 8) {
        const Likelihoods seen = likelihoods({sigma_m}, grid, (k - 1 + share) * cell_length_m);
        for (int i = 1; i <= cells; i += cells < 12 ? 1 : 4) {
          ASSERT_NEAR(theorem_6(seen, i).probability, enumerate_configurations(seen, i).probability,
                      1e-12)
              << "N " << cells << ", sigma " << sigma_m << ", cells of " << cell_length_m
              << ", z in " << k << ", cell " << i;
        }
      }
    }
  }
}

TEST(Theorem6, EqualsTheEnumerationWhereverZLies) {
  for (const double share : {0.5, 0.1, 0.77, 1.0}) {
    for (int cells = 1; cells < 12; ++cells) {
      expect_theorem_6_to_be_the_enumeration(cells, share);
    }
  }
}

class Theorem6Large : public testing::TestWithParam<int> {};

TEST_P(Theorem6Large, EqualsTheEnumeration) {
  expect_theorem_6_to_be_the_enumeration(GetParam(), 0.5);
}

INSTANTIATE_TEST_SUITE_P(Cells, Theorem6Large, testing::Range(12, 19));

// Table 4.3 of the thesis, to its printed digits, on its own local grid: 50 m, z = 25 m.
TEST(Theorem6, GivesTable43WithTheExponentHalved) {
  const LocalGrid grid{.cells = 500, .cell_length_m = 0.1};
  const int k = 251;
  const Likelihoods seen = likelihoods({0.1}, grid, grid.distance_m(k));
  EXPECT_NEAR(theorem_6(seen, k - 2).probability, 0.18, 0.006);
  EXPECT_NEAR(theorem_6(seen, k - 1).probability, 0.48, 0.005);
  EXPECT_NEAR(theorem_6(seen, k).probability, 0.60, 0.005);
  EXPECT_NEAR(theorem_6(seen, k + 1).probability, 0.54, 0.005);
  EXPECT_NEAR(theorem_6(seen, k + 2).probability, 0.50, 0.006);
  const Likelihoods printed = likelihoods({0.1, Exponent::kAsPrinted}, grid, grid.distance_m(k));
  EXPECT_GT(std::abs(theorem_6(printed, k).probability - 0.60), 0.05);
}

// The firmware's tables know no ends of the grid and no distances, only i - k.
TEST(SingleTarget, IsTheorem6AwayFromTheEnds) {
  for (const double sigma_m : {0.03, 0.1, 0.2}) {
    for (const double cell_length_m : {0.05, 0.1, 0.4}) {
      if (cell_length_m > 4 * sigma_m) {
        continue;  // not a SingleTarget
      }
      const LocalGrid grid{.cells = 400, .cell_length_m = cell_length_m};
      const int k = 201;
      const Likelihoods seen = likelihoods({sigma_m}, grid, grid.distance_m(k));
      const sensor_model::SingleTarget model{sigma_m, cell_length_m};
      for (int offset = -32; offset <= 32; ++offset) {
        EXPECT_NEAR(model.probability(offset), theorem_6(seen, k + offset).probability, 1e-12)
            << "sigma " << sigma_m << ", cells of " << cell_length_m << ", offset " << offset;
      }
    }
  }
}

// A density of the measurement: its integral over z is 1, and its height at z = d that of a normal
// distribution, 0.39894 / sigma.
TEST(RangeSensor, IsANormalDistribution) {
  const RangeSensor sensor{0.1};
  double integral = 0;
  for (int i = -1000; i <= 1000; ++i) {
    integral += 0.001 * static_cast<double>(sensor.likelihood(25 + 0.001 * i, 25));
  }
  EXPECT_NEAR(integral, 1, 1e-12);
  EXPECT_NEAR(static_cast<double>(sensor.likelihood(25, 25)), 3.989422804014327, 1e-14);
  EXPECT_NEAR(static_cast<double>(sensor.likelihood(25.1, 25)), 2.419707245191434, 1e-12);
}

// Equation 4.1 as printed is no density: its integral is 1 / sqrt(2).
TEST(RangeSensor, EquationFourPointOneIsNot) {
  const RangeSensor printed{0.1, Exponent::kAsPrinted};
  double integral = 0;
  for (int i = -1000; i <= 1000; ++i) {
    integral += 0.001 * static_cast<double>(printed.likelihood(25 + 0.001 * i, 25));
  }
  EXPECT_NEAR(integral, std::sqrt(0.5), 1e-12);
}

// Equation 4 of the many-core paper, with figure 3's z = 6 m and sigma = 0.5 m.
TEST(AnalyticModel, HasAFreePartAPeakAndAnUnknownPart) {
  const AnalyticModel model{.lambda = [](double) { return 0.9; },
                            .sigma_m = [](double) { return 0.5; },
                            .free = [](double d_m, double) { return 0.01 + 0.01 * d_m; }};
  EXPECT_EQ(model.probability(1, 6), 0.02);
  EXPECT_EQ(model.probability(6, 6), 0.9);
  EXPECT_NEAR(model.probability(5.5, 6), 0.9 * 0.6065306597126334, 1e-15);  // exp(-1/2)
  EXPECT_NEAR(model.probability(6.5, 6), 0.9 * 0.6065306597126334, 1e-15);
  EXPECT_EQ(model.probability(7, 6), 0.5);
  EXPECT_EQ(model.probability(40, 6), 0.5);
}

}  // namespace
}  // namespace iog::lab::reference
