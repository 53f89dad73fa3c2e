// Bayes, of the thesis's section 2.4, as a product and as a sum: section 3.1's laws.
#include "lab/reference/fusion.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

namespace iog::lab::reference {
namespace {

// 0.02 ... 0.98 in steps of 0.06: 1/2 among them, and pairs of p and 1 - p.
std::vector<double> probabilities() {
  std::vector<double> values;
  for (int i = 1; i < 50; i += 3) {
    values.push_back(0.02 * i);
  }
  return values;
}

// By hand: 0.8 * 0.6 / (0.8 * 0.6 + 0.2 * 0.4) = 48 / 56; 0.9 against 0.2: 18 / (18 + 8).
TEST(BayesianFusion, ByHand) {
  EXPECT_NEAR(fuse_bayes(0.8, 0.6), 6.0 / 7, 1e-15);
  EXPECT_NEAR(fuse_bayes(0.9, 0.2), 9.0 / 13, 1e-15);
}

// Property 3.1.2.
TEST(BayesianFusion, ReinforcesMeasurementsThatAgree) {
  for (const double p : probabilities()) {
    for (const double q : probabilities()) {
      if (p > 0.5 && q > 0.5) {
        EXPECT_GT(fuse_bayes(p, q), std::max(p, q)) << p << ", " << q;
      }
      if (p < 0.499 && q < 0.499) {
        EXPECT_LT(fuse_bayes(p, q), p < q ? p : q) << p << ", " << q;
      }
    }
  }
}

// Property 3.1.3: between 1/2 and the one that is surer. Pairs of p and 1 - p have no surer one.
TEST(BayesianFusion, MitigatesMeasurementsThatConflict) {
  for (const double p : probabilities()) {
    for (const double q : probabilities()) {
      if (p >= 0.499 || q <= 0.501) {
        continue;
      }
      const double surer = 0.5 - p > q - 0.5 ? p : q;
      const double fused = fuse_bayes(p, q);
      if (p + q < 0.999 || p + q > 1.001) {
        EXPECT_LT(surer < 0.5 ? surer : 0.5, fused) << p << ", " << q;
        EXPECT_GT(surer < 0.5 ? 0.5 : surer, fused) << p << ", " << q;
      }
    }
  }
}

// Property 3.1.4. The incremental property 3.1.1 is associativity: one measurement after another
// gives what any grouping gives.
TEST(BayesianFusion, IsAnAbelianGroup) {
  for (const double p : probabilities()) {
    EXPECT_NEAR(fuse_bayes(p, 0.5), p, 1e-15);
    EXPECT_NEAR(fuse_bayes(p, 1 - p), 0.5, 1e-15);
    for (const double q : probabilities()) {
      EXPECT_EQ(fuse_bayes(p, q), fuse_bayes(q, p));
      EXPECT_GT(fuse_bayes(p, q), 0);
      EXPECT_LT(fuse_bayes(p, q), 1);
      for (const double r : probabilities()) {
        EXPECT_NEAR(fuse_bayes(p, fuse_bayes(q, r)), fuse_bayes(fuse_bayes(p, q), r), 1e-14);
      }
    }
  }
}

// Equation 3.12, the numerical instability of table 2.3: who has reached 0 or 1 stays there.
// Sixteen measurements of 0.99 are enough, as a double has 53 bits.
TEST(BayesianFusion, IsStuckOnceItHasReachedCertainty) {
  double p = 0.5;
  for (int i = 0; i < 16; ++i) {
    p = fuse_bayes(p, 0.99);
  }
  EXPECT_EQ(p, 1);
  EXPECT_EQ(fuse_bayes(p, 0.01), 1);
}

TEST(LogOddsFusion, ByHand) {
  EXPECT_EQ(log_odds(0.5), 0);
  EXPECT_NEAR(log_odds(0.9), 2.19722457733621938, 1e-15);  // log 9
  EXPECT_NEAR(probability_of_log_odds(-2.19722457733621938), 0.1, 1e-15);
}

TEST(LogOddsFusion, EqualsBayesianFusion) {
  for (const double p : probabilities()) {
    EXPECT_NEAR(probability_of_log_odds(log_odds(p)), p, 1e-15);
    for (const double q : probabilities()) {
      EXPECT_NEAR(probability_of_log_odds(log_odds(p) + log_odds(q)), fuse_bayes(p, q), 1e-14)
          << p << ", " << q;
    }
  }
}

// What the product of probabilities cannot do: after a thousand measurements of one kind, as many
// of the other take it all back.
TEST(LogOddsFusion, IsNeverStuck) {
  double l = 0;
  for (int i = 0; i < 1000; ++i) {
    l += log_odds(0.99);
  }
  EXPECT_EQ(probability_of_log_odds(l), 1);
  for (int i = 0; i < 1001; ++i) {
    l += log_odds(0.01);
  }
  EXPECT_NEAR(probability_of_log_odds(l), 0.01, 1e-10);
}

TEST(LogOddsFusion, HasAProbabilityForEverySum) {
  EXPECT_EQ(probability_of_log_odds(-1e6), 0);
  EXPECT_EQ(probability_of_log_odds(1e6), 1);
}

}  // namespace
}  // namespace iog::lab::reference
