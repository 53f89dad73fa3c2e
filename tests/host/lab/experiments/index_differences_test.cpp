// Table 4.6's statistics on evidence so small that they can be worked out by hand, and the bound
// that holds for any.
#include "lab/experiments/numerical_quality/index_differences.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::lab {
namespace {

using index::Quantisation;

constexpr auto kCells = static_cast<double>(geometry::kCellCount);

double p_of(double epsilon, int n) {
  return 1 / (1 + std::pow((0.5 - epsilon) / (0.5 + epsilon), n));
}

// Table 4.3: the scan point's cell is 0.604, and index 2 at epsilon = 0.05.
TEST(IndexDifferences, OneHitInOneCell) {
  const auto model = probabilities({});
  std::vector<QuantisedModel> rows{{model, 0.05, Quantisation::kBlurring}};
  compare({.cells = {{7, 0}}, .hits = {7}}, model, rows);
  const Differences& found = rows[0].differences;
  const double expected = model[kFarSteps] - p_of(0.05, 2);
  EXPECT_NEAR(expected, 0.604 - 0.599, 0.001);
  EXPECT_NEAR(found.largest, expected, 1e-12);
  EXPECT_NEAR(rows[0].error_at(model, 0), expected, 1e-12);
  EXPECT_EQ(found.largest_of, 1U);
  EXPECT_EQ(found.cells, geometry::kCellCount);
  EXPECT_EQ(found.known, 1U);
  EXPECT_NEAR(found.mean(), expected / kCells, 1e-18);
  EXPECT_NEAR(found.mean_of_known(), expected, 1e-12);
  EXPECT_NEAR(found.root_mean_square_of_known(), expected, 1e-12);
  EXPECT_NEAR(found.standard_deviation(), expected * std::sqrt((1 - 1 / kCells) / kCells), 1e-12);
  EXPECT_NEAR(found.sum_near, found.sum, 1e-18);
  EXPECT_EQ(found.largest_index, 2);
  EXPECT_EQ(found.above_bound, 0U);
}

// Two beams see 0.05 as index -14, which is 0.0568: p_-28 against 0.05^2 / (0.05^2 + 0.95^2).
TEST(IndexDifferences, FreeCellsAreNotNear) {
  const auto model = probabilities({});
  std::vector<QuantisedModel> rows{{model, 0.05, Quantisation::kBlurring}};
  const FrameEvidence evidence{.cells = {{7, -kFarSteps}, {7, -3}, {8, -2}}, .hits = {}};
  compare(evidence, model, rows);
  compare(evidence, model, rows);
  const Differences& found = rows[0].differences;
  const double free = p_of(0.05, -28) - 0.0025 / (0.0025 + 0.9025);
  EXPECT_NEAR(found.sum - found.sum_near, 2 * free, 1e-12);
  EXPECT_EQ(found.known, 4U);
  EXPECT_EQ(found.cells, 2 * geometry::kCellCount);
}

// Of the profile of table 4.3 only k - 3 to k + 2 differ from 1/2 by 0.001 or more. What a beam
// says of the cells behind them counts in the sums, but makes nothing known.
TEST(IndexDifferences, WhatABeamSaysNothingOfIsNotKnown) {
  const auto model = probabilities({});
  std::vector<QuantisedModel> rows{{model, 1e-6, Quantisation::kBlurring}};
  FrameEvidence evidence{.cells = {}, .hits = {}};
  for (int step = -3; step <= kFarSteps; ++step) {
    EXPECT_EQ(std::abs(model[slot_of(step)] - 0.5) >= 0.001, step <= 2) << step;
    evidence.cells.push_back(
        {static_cast<std::uint32_t>(10 + step), static_cast<std::int8_t>(step)});
  }
  compare(evidence, model, rows);
  const Differences& found = rows[0].differences;
  EXPECT_EQ(found.known, 6U);
  EXPECT_GT(found.sum, found.sum_known);
  EXPECT_NEAR(found.mean_of_known(), found.sum_known / 6, 1e-18);
}

// N measurements are wrong by less than N steps of the set, of which none is worth more than
// epsilon (property 3.3.5); by more than one as soon as their errors have the same sign.
TEST(IndexDifferences, NMeasurementsAreWrongByNEpsilonAtMost) {
  const auto model = probabilities({});
  std::vector<QuantisedModel> rows;
  for (const double epsilon : {1e-1, 1e-3, 1e-6}) {
    rows.emplace_back(model, epsilon, Quantisation::kBlurring);
    rows.emplace_back(model, epsilon, Quantisation::kNearest);
  }
  tests::Random random(5);
  FrameEvidence evidence;
  for (int i = 0; i < 20'000; ++i) {
    evidence.cells.push_back({static_cast<std::uint32_t>(random.between(0, 999)),
                              static_cast<std::int8_t>(random.between(-3, 3))});
  }
  compare(evidence, model, rows);
  for (const QuantisedModel& row : rows) {
    EXPECT_EQ(row.differences.above_bound, 0U);
    EXPECT_GT(row.differences.largest, row.epsilon);
    EXPECT_LT(row.differences.largest, row.epsilon * row.differences.largest_of);
  }
}

}  // namespace
}  // namespace iog::lab
