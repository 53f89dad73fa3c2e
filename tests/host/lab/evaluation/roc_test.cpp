#include "lab/evaluation/roc.hpp"

#include <cstdint>
#include <vector>

#include "gtest/gtest.h"

#include "tools/simulate/random.hpp"

namespace iog::lab {
namespace {

using Scores = std::vector<std::int32_t>;

const std::vector<CellState> kTwoAndThree{CellState::kOccupied, CellState::kFree, CellState::kFree,
                                          CellState::kOccupied, CellState::kFree};

double area_of(const std::vector<CellState>& truth, const Scores& scores) {
  Roc roc;
  roc.add(truth, scores);
  return roc.area();
}

TEST(Roc, KnowsAPerfectAnInvertedAndABlindScorer) {
  EXPECT_EQ(area_of(kTwoAndThree, {2, -14, -7, 4, 0}), 1);
  EXPECT_EQ(area_of(kTwoAndThree, {-14, 2, 4, -14, 2}), 0);
  EXPECT_EQ(area_of(kTwoAndThree, {3, 3, 3, 3, 3}), 0.5);
  EXPECT_EQ(area_of({}, {}), 0.5);
}

// The definition: over all pairs of an occupied and a free cell, 1 if the occupied one scores
// higher, 1/2 for a tie.
double area_by_pairs(const std::vector<CellState>& truth, const Scores& scores) {
  double won = 0;
  double pairs = 0;
  for (std::size_t a = 0; a < truth.size(); ++a) {
    for (std::size_t b = 0; b < truth.size(); ++b) {
      if (truth[a] == CellState::kOccupied && truth[b] == CellState::kFree) {
        won += scores[a] > scores[b] ? 1 : (scores[a] == scores[b] ? 0.5 : 0);
        pairs += 1;
      }
    }
  }
  return won / pairs;
}

TEST(Roc, AgreesWithTheCountOfPairs) {
  tools::Random random(11);
  for (const std::size_t score_count : {2U, 10U, 1000U}) {
    std::vector<CellState> truth;
    Scores scores;
    for (int i = 0; i < 400; ++i) {
      truth.push_back(static_cast<CellState>(random.below(3)));
      const auto lean = truth.back() == CellState::kOccupied ? score_count / 3 : 0;
      scores.push_back(static_cast<std::int32_t>(random.below(score_count) + lean));
    }
    EXPECT_NEAR(area_of(truth, scores), area_by_pairs(truth, scores), 1e-12);
  }
}

// Frames are pooled, not averaged, and in any order; probabilities rank as their indexes do.
TEST(Roc, PoolsFramesAndTakesProbabilities) {
  const std::vector<CellState> truth{CellState::kOccupied, CellState::kFree};
  Roc roc;
  roc.add(truth, Scores{2, 0});
  roc.add(truth, Scores{1, 1});
  EXPECT_EQ(roc.area(), 3.5 / 4);
  Roc same;
  same.add(truth, std::vector{0.6, 0.6});
  same.add(truth, std::vector{0.7, 0.5});
  EXPECT_EQ(same.area(), roc.area());
}

// Occupied: 2, 4; free: -14, 2, 0.
TEST(Roc, KnowsEveryThreshold) {
  Roc roc;
  roc.add(kTwoAndThree, Scores{2, -14, 2, 4, 0});
  EXPECT_EQ(roc.at_least(5), std::pair(0.0, 0.0));
  EXPECT_EQ(roc.at_least(3), std::pair(0.0, 0.5));
  EXPECT_EQ(roc.at_least(2), std::pair(1.0 / 3, 1.0));
  EXPECT_EQ(roc.at_least(-127), std::pair(1.0, 1.0));
  EXPECT_EQ(roc.recall_within(0), 0.5);
  EXPECT_EQ(roc.recall_within(0.3), 0.5);
  EXPECT_EQ(roc.recall_within(0.4), 1);
}

// The area is that below the curve, by trapezia.
TEST(Roc, CurveRisesFromNothingToEverythingAboveItsArea) {
  Roc roc;
  roc.add(kTwoAndThree, Scores{2, -14, 2, 4, 0});
  const auto curve = roc.curve();
  EXPECT_EQ(curve.front(), std::pair(0.0, 0.0));
  EXPECT_EQ(curve.back(), std::pair(1.0, 1.0));
  double area = 0;
  for (std::size_t i = 1; i < curve.size(); ++i) {
    area += (curve[i].first - curve[i - 1].first) * (curve[i].second + curve[i - 1].second) / 2;
  }
  EXPECT_DOUBLE_EQ(area, roc.area());
}

}  // namespace
}  // namespace iog::lab
