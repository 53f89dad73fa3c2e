// Section 6.6.1 of the thesis: from half-lives to what is left and to Mercier's rates.
#include "lab/reference/evidential/temporal_discounting.hpp"

#include <array>
#include <gtest/gtest.h>

namespace iog::lab::reference::evidential {
namespace {

constexpr std::array kCase1{1.0, 4.0, 15.0};
constexpr std::array kCase2{5.0, 4.0, 15.0};

void expect_near(const std::vector<double>& actual, const std::array<double, 3>& expected,
                 double tolerance) {
  ASSERT_EQ(actual.size(), 3U);
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_NEAR(actual[i], expected[i], tolerance) << i;
  }
}

// Equations 6.54 and 6.55.
TEST(DecayRates, AreThoseOfTheThesis) {
  expect_near(decay_rates(kCase1), {0.6931, 0.1733, 0.0462}, 5e-5);
  expect_near(decay_rates(kCase2), {0.1386, 0.1733, 0.0462}, 5e-5);
}

// Equations 6.56 and 6.57.
TEST(WhatIsLeft, IsThatOfTheThesis) {
  expect_near(left_after(4, decay_rates(kCase1)), {0.0625, 0.5, 0.8312}, 5e-5);
  expect_near(left_after(4, decay_rates(kCase2)), {0.5743, 0.5, 0.8312}, 5e-5);
}

// "4096, 32 768 and 16 times" (section 6.6.2).
TEST(WhatIsLeft, IsAPowerOfTwoAfterWholeHalfLives) {
  expect_near(left_after(60, decay_rates(kCase2)), {1.0 / 4096, 1.0 / 32'768, 1.0 / 16}, 1e-15);
}

// Equations 6.58 and 6.59. The first rate of case 1 is no rate.
TEST(ContextualRates, AreThoseOfTheThesis) {
  expect_near(contextual_rates(left_after(4, decay_rates(kCase1))), {-1.5787, 0.6777, 0.8061},
              5e-5);
  expect_near(contextual_rates(left_after(4, decay_rates(kCase2))), {0.1493, 0.0228, 0.4122}, 5e-5);
}

// Equation 6.49: what is left of a singleton is what the rates of all others leave.
TEST(ContextualRates, LeaveWhatWasAskedFor) {
  const std::vector<double> left{0.9, 0.8, 0.95, 0.7};
  const std::vector<double> rates = contextual_rates(left);
  for (std::size_t i = 0; i < left.size(); ++i) {
    double product = 1;
    for (std::size_t j = 0; j < rates.size(); ++j) {
      product *= j == i ? 1 : 1 - rates[j];
    }
    EXPECT_NEAR(product, left[i], 1e-15);
  }
}

}  // namespace
}  // namespace iog::lab::reference::evidential
