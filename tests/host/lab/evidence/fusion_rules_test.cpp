// The rules of fusion on a few cells, worked out by hand from docs/model.md section 3 and the
// thesis's section 2.4.
#include "lab/evidence/fusion_rules.hpp"

#include <gtest/gtest.h>
#include <utility>

#include "fakes/random.hpp"

namespace iog::lab {
namespace {

constexpr std::int8_t kFree = -kFarSteps;

// Blurring at epsilon = 0.05 (Table 4.3): -14 before k - 2, -7, 0, +2.
ByStep<std::int32_t> table_4_3() {
  ByStep<std::int32_t> values{};
  for (int step = -kFarSteps; step <= -3; ++step) {
    values[slot_of(step)] = -14;
  }
  values[kFarSteps - 2] = -7;
  values[kFarSteps] = 2;
  return values;
}

// 0.2 before the scan point's cell, 0.6 in it, 1/2 behind.
ByStep<double> simple_model() {
  ByStep<double> values{};
  values.fill(0.5);
  for (std::size_t i = 0; i < kFarSteps; ++i) {
    values[i] = 0.2;
  }
  values[kFarSteps] = 0.6;
  return values;
}

FrameEvidence of_cell_5(const std::vector<std::int8_t>& steps) {
  FrameEvidence evidence;
  for (const std::int8_t step : steps) {
    evidence.cells.push_back({5, step});
  }
  return evidence;
}

std::int32_t fuse(const std::vector<std::int8_t>& steps, IndexRule rule, std::int32_t limit = 127) {
  const auto cells = fuse_indexes(of_cell_5(steps), table_4_3(), rule, limit);
  EXPECT_EQ(cells.size(), geometry::kCellCount);
  EXPECT_EQ(cells[4], 0);
  EXPECT_EQ(cells[6], 0);
  return cells[5];
}

double fuse(const std::vector<std::int8_t>& steps) {
  const auto cells = fuse_probabilities(of_cell_5(steps), simple_model());
  EXPECT_EQ(cells.size(), geometry::kCellCount);
  EXPECT_EQ(cells[4], 0.5);
  EXPECT_EQ(cells[6], 0.5);
  return cells[5];
}

TEST(IndexRules, OneHitAndOnePassingBeam) {
  EXPECT_EQ(fuse({0, kFree}, IndexRule::kHitsWin), 2);
  EXPECT_EQ(fuse({0, kFree}, IndexRule::kBayes), -12);
  EXPECT_EQ(fuse({0, kFree}, IndexRule::kSequential), -12);
}

// Ten beams saturate at -127 before the hit, after the hit they do so all the same.
TEST(IndexRules, OnlyTheSequentialSumKnowsTheOrder) {
  std::vector<std::int8_t> hit_last(10, kFree);
  hit_last.push_back(0);
  const std::vector<std::int8_t> hit_first(hit_last.rbegin(), hit_last.rend());
  EXPECT_EQ(fuse(hit_last, IndexRule::kSequential), -125);
  EXPECT_EQ(fuse(hit_first, IndexRule::kSequential), -127);
  EXPECT_EQ(fuse(hit_last, IndexRule::kBayes), -125);
  EXPECT_EQ(fuse(hit_first, IndexRule::kBayes), -125);
  EXPECT_EQ(fuse(hit_last, IndexRule::kHitsWin), 2);
  EXPECT_EQ(fuse(hit_first, IndexRule::kHitsWin), 2);
}

TEST(IndexRules, SaturateAtTheirLimit) {
  EXPECT_EQ(fuse(std::vector<std::int8_t>(100, 0), IndexRule::kBayes), 127);
  EXPECT_EQ(fuse(std::vector<std::int8_t>(100, kFree), IndexRule::kBayes), -127);
  EXPECT_EQ(fuse(std::vector<std::int8_t>(100, kFree), IndexRule::kSequential, 1 << 30), -1400);
  EXPECT_EQ(fuse(std::vector<std::int8_t>(100, 0), IndexRule::kHitsWin, 1 << 30), 200);
}

// Without saturation the sum is a sum: associative and commutative.
TEST(IndexRules, WithoutSaturationSequentialIsBayes) {
  tests::Random random(3);
  FrameEvidence evidence;
  for (int i = 0; i < 20'000; ++i) {
    evidence.cells.push_back({static_cast<std::uint32_t>(random.between(0, 50)),
                              static_cast<std::int8_t>(random.between(-kFarSteps, kFarSteps))});
  }
  EXPECT_EQ(fuse_indexes(evidence, table_4_3(), IndexRule::kSequential, 1 << 30),
            fuse_indexes(evidence, table_4_3(), IndexRule::kBayes, 1 << 30));
  EXPECT_NE(fuse_indexes(evidence, table_4_3(), IndexRule::kSequential, 127),
            fuse_indexes(evidence, table_4_3(), IndexRule::kBayes, 127));
}

// An exchange of a mark with the carving behind it never lowers a saturated sum: of all orders that
// of bayes, which has exchanged them all, gives the most. And no order shows in the two rules.
TEST(IndexRules, BayesIsTheMostThatAnyOrderGives) {
  tests::Random random(4);
  for (int round = 0; round < 8; ++round) {
    FrameEvidence evidence;
    for (int i = 0; i < 2'000; ++i) {
      evidence.cells.push_back({static_cast<std::uint32_t>(random.between(0, 9)),
                                static_cast<std::int8_t>(random.one_in(8) ? -3 : 0)});
    }
    const auto bayes = fuse_indexes(evidence, table_4_3(), IndexRule::kBayes, 127);
    const auto hits_win = fuse_indexes(evidence, table_4_3(), IndexRule::kHitsWin, 127);
    for (std::size_t i = evidence.cells.size(); i > 1; --i) {
      std::swap(evidence.cells[i - 1], evidence.cells[random.below(i)]);
    }
    const auto sequential = fuse_indexes(evidence, table_4_3(), IndexRule::kSequential, 127);
    for (std::size_t cell = 0; cell < 10; ++cell) {
      EXPECT_LE(sequential[cell], bayes[cell]);
    }
    ASSERT_EQ(fuse_indexes(evidence, table_4_3(), IndexRule::kBayes, 127), bayes);
    ASSERT_EQ(fuse_indexes(evidence, table_4_3(), IndexRule::kHitsWin, 127), hits_win);
  }
}

// Odds multiply: 1/4 and 3/2.
TEST(Probabilities, BayesMultipliesOdds) {
  EXPECT_NEAR(fuse({0, -3}), 3.0 / 11, 1e-12);
  EXPECT_NEAR(fuse({-3, -3}), 1.0 / 17, 1e-12);
  EXPECT_NEAR(fuse({0, 4}), 0.6, 1e-12);
  EXPECT_NEAR(fuse({4}), 0.5, 1e-12);
}

}  // namespace
}  // namespace iog::lab
