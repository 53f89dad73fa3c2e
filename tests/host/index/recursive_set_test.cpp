// The recursive set: fusion of probabilities is addition of indexes (thesis section 3.3).
#include "index/recursive_set.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::index {
namespace {

// Bayesian fusion of two independent estimates, thesis equation (3.2).
double fuse(double p, double q) { return p * q / (p * q + (1 - p) * (1 - q)); }

TEST(RecursiveSet, IsCentredAtOneHalfAndBeginsAtEpsilon) {
  for (const double epsilon : {0.05, 0.01, 0.005, 1e-4}) {
    const RecursiveSet set(epsilon);
    EXPECT_EQ(set.probability(0), 0.5);
    EXPECT_NEAR(set.probability(1), 0.5 + epsilon, 1e-15);
    EXPECT_NEAR(set.probability(-1), 0.5 - epsilon, 1e-15);
    for (int n = 1; n < 100; ++n) {
      EXPECT_NEAR(set.probability(n) + set.probability(-n), 1, 1e-14);
      EXPECT_GT(set.probability(n), set.probability(n - 1));
    }
  }
}

TEST(RecursiveSet, FusionOfProbabilitiesIsAdditionOfIndexes) {
  const RecursiveSet set(0.05);
  for (int n = -60; n <= 60; ++n) {
    for (int m = -60; m <= 60; ++m) {
      // 1 - p loses digits where p is near 1, hence not 1e-15.
      ASSERT_NEAR(fuse(set.probability(n), set.probability(m)), set.probability(n + m), 1e-10)
          << n << " + " << m;
    }
  }
}

// docs/model.md section 2: at epsilon = 0.05, p_-127 < 1e-11.
TEST(RecursiveSet, AnInt8ReachesCertaintyAtEpsilonFivePercent) {
  const RecursiveSet set(0.05);
  EXPECT_LT(set.probability(-127), 1e-11);
  EXPECT_GT(set.probability(127), 1 - 1e-11);
}

TEST(RecursiveSet, QuantisingAnElementGivesItsIndex) {
  const RecursiveSet set(0.05);
  for (int n = -100; n <= 100; ++n) {
    EXPECT_EQ(set.quantise(set.probability(n), Quantisation::kNearest), n);
    EXPECT_EQ(set.quantise(set.probability(n), Quantisation::kBlurring), n);
  }
}

// Definition 3.4.4: blurring takes the neighbour towards 1/2, nearest the one that is closer.
TEST(RecursiveSet, QuantisationChoosesBetweenTheTwoNeighbours) {
  tests::Random random(7);
  for (const double epsilon : {0.05, 0.01, 1e-3}) {
    const RecursiveSet set(epsilon);
    for (int i = 0; i < 2000; ++i) {
      const double p = static_cast<double>(random.between(1, 99'999)) / 100'000;
      const int blurred = set.quantise(p, Quantisation::kBlurring);
      const int nearest = set.quantise(p, Quantisation::kNearest);
      const double to_half = p < 0.5 ? 0.5 - p : p - 0.5;
      const double blurred_to_half =
          p < 0.5 ? 0.5 - set.probability(blurred) : set.probability(blurred) - 0.5;
      const int outward = p < 0.5 ? blurred - 1 : blurred + 1;
      const double outward_to_half =
          p < 0.5 ? 0.5 - set.probability(outward) : set.probability(outward) - 0.5;
      ASSERT_LE(blurred_to_half, to_half) << p;
      ASSERT_GT(outward_to_half, to_half) << p;
      const bool outward_is_nearer = outward_to_half - to_half < to_half - blurred_to_half;
      ASSERT_EQ(nearest, outward_is_nearer ? outward : blurred) << p;
    }
  }
}

TEST(RecursiveSet, SmallEpsilonNeedsIndexesWiderThanAByte) {
  EXPECT_LT(RecursiveSet(1e-6).quantise(0.05, Quantisation::kBlurring), -700'000);
}

}  // namespace
}  // namespace iog::index
