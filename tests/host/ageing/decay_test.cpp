// The decay by bits of a time against the exponential, over every time that there is.
#include "ageing/decay.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace iog::ageing {
namespace {

constexpr long double kOne = 2'147'483'648.0L;  // 2^31

// What a mass with this part left after 100 ms has left after a time, in 2^-31.
long double exact(long double left_after_100_ms, std::uint32_t ms) {
  return std::exp(std::log(left_after_100_ms) * static_cast<long double>(ms) / 100) * kOne;
}

// Where a long double is a double, as on the Cortex-A9, it is not exact to one unit either.
constexpr long double kReferenceError = 1e-4L;

void expect_powers(const DecayTable& table, long double left_after_100_ms) {
  for (std::size_t j = 0; j < table.size(); ++j) {
    const long double loss = exact(left_after_100_ms, std::uint32_t{1} << j) - table[j];
    EXPECT_GE(loss, -kReferenceError) << j;
    EXPECT_LT(loss, 1 + kReferenceError) << j;
  }
}

const long double kShared = std::pow(0.90L, 0.25L) * std::pow(0.99L, 0.75L);

TEST(Decay, TablesAreTheFormulaRoundedDown) {
  expect_powers(kUsualDecays.dynamic, 0.90L);
  expect_powers(kUsualDecays.fixed, 0.99L);
  expect_powers(kUsualDecays.shared, kShared);
}

// Each of up to 16 factors and of up to 15 products loses less than one unit.
void expect_exponential(const DecayTable& table, long double left_after_100_ms) {
  for (std::uint32_t ms = 0; ms <= 65'535; ++ms) {
    const long double loss = exact(left_after_100_ms, ms) - decay(table, ms);
    ASSERT_GE(loss, -kReferenceError) << ms;
    ASSERT_LT(loss, 31) << ms;
  }
}

TEST(Decay, IsExponentialAtEveryTime) {
  expect_exponential(kUsualDecays.dynamic, 0.90L);
  expect_exponential(kUsualDecays.fixed, 0.99L);
  expect_exponential(kUsualDecays.shared, kShared);
}

TEST(Decay, NeverGrows) {
  for (std::uint32_t ms = 1; ms <= 65'535; ++ms) {
    ASSERT_LE(decay(kUsualDecays.dynamic, ms), decay(kUsualDecays.dynamic, ms - 1)) << ms;
    ASSERT_LE(decay(kUsualDecays.fixed, ms), decay(kUsualDecays.fixed, ms - 1)) << ms;
  }
}

// The order of the factors is part of the contract, because each product is rounded: lowest first.
TEST(Decay, TakesTheLowestBitFirst) {
  for (std::uint32_t ms = 1; ms <= 65'535; ms += 7) {
    std::uint64_t left = 0x8000'0000;
    for (std::size_t j = 0; j < 16; ++j) {
      if ((ms >> j & 1) != 0) {
        left = left * kUsualDecays.fixed[j] / 0x8000'0000;
      }
    }
    ASSERT_EQ(decay(kUsualDecays.fixed, ms), left) << ms;
  }
}

}  // namespace
}  // namespace iog::ageing
