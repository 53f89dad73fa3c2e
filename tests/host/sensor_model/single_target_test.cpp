// Theorem 6 against what it was derived from: the sum over all 2^N grid configurations.
#include "sensor_model/single_target.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "fakes/effort.hpp"

namespace iog::sensor_model {
namespace {

// Thesis appendix B.1: every configuration of N cells is equally likely, and the sensor sees the
// first occupied cell. Bit i of a configuration: cell i is occupied. Cell k holds the measurement.
double enumerated(int cells, int i, int k, double cell_m, double sigma_m) {
  double occupied = 0;
  double all = 0;
  for (unsigned configuration = 1; configuration < (1U << cells); ++configuration) {
    int first = 0;
    while ((configuration >> first & 1U) == 0) {
      ++first;
    }
    const double distance = (first - k) * cell_m / sigma_m;
    const double likelihood = std::exp(-0.5 * distance * distance);
    all += likelihood;
    occupied += (configuration >> i & 1U) != 0 ? likelihood : 0;
  }
  return occupied / all;
}

void expect_equal_to_enumeration(double cell_m, double sigma_m, double tolerance) {
  const int cells = tests::effort(16, 11);
  const int k = cells / 2;
  for (int i = 1; i < cells - 1; ++i) {
    EXPECT_NEAR((SingleTarget{sigma_m, cell_m}.probability(i - k)),
                enumerated(cells, i, k, cell_m, sigma_m), tolerance)
        << "cell " << i - k << ", cell " << cell_m << " m, sigma " << sigma_m << " m";
  }
}

// The enumerated grid has two ends, the profile none: what the Gaussian has left at the ends of a
// grid of 11 cells bounds the difference.
TEST(Theorem6, EqualsTheEnumerationOfAllConfigurations) {
  expect_equal_to_enumeration(0.10, 0.10, 2e-5);
  expect_equal_to_enumeration(0.20, 0.10, 1e-12);
  expect_equal_to_enumeration(0.50, 0.10, 1e-12);
  expect_equal_to_enumeration(0.03, 0.02, 1e-9);
}

// Figure 4.6: a cell much longer than sigma is certainly occupied, one of a quarter of it stays at
// 1/2. (The thesis says that it does not even get there; by its own theorem no cell from k on is
// below 1/2. The maximum is 0.5002, far from p_1 = 0.55 all the same.)
TEST(Theorem6, TheCellSizeDecidesHowSureAHitIs) {
  EXPECT_GT((SingleTarget{0.1, 0.5}.probability(0)), 0.99);
  EXPECT_NEAR((SingleTarget{0.1, 0.025}.probability(0)), 0.5, 0.001);
}

TEST(Theorem6, IsEmptyBeforeAndUnknownBehind) {
  const SingleTarget lux{0.1, 0.1};
  EXPECT_LT(lux.probability(-6), 1e-6);
  EXPECT_NEAR(lux.probability(20), 0.5, 1e-12);
}

}  // namespace
}  // namespace iog::sensor_model
