// The weights of evidence against their formulas, for every time that there is.
#include "ageing/gains.hpp"

#include <cmath>
#include <gtest/gtest.h>

namespace iog::ageing {
namespace {

// The nearest integer to a / b, a half up, in whole numbers.
std::int64_t nearest(std::int64_t a, std::int64_t b) { return (2 * a + b) / (2 * b); }

TEST(Gains, GrowEvenlyWithTime) {
  for (std::uint32_t ms = 1; ms <= 100; ++ms) {
    const evidence::Gains gains = gains_after(ms, kGainsByTime);
    EXPECT_EQ(gains.persistence, nearest(32'768LL * ms, 3000)) << ms;
    EXPECT_EQ(gains.decline, nearest(6 * 32'768LL * ms, 3000)) << ms;
    EXPECT_EQ(gains.specialisation,
              std::min<std::int64_t>(nearest(32'768LL * ms * 15, 1000), 32'767))
        << ms;
  }
}

// 0.3 of the doubt is left after 100 ms, whatever the looks in between.
TEST(FreeMass, IsOfTimeAndNotOfScans) {
  for (std::uint32_t ms = 1; ms <= 100; ++ms) {
    const long double doubt = std::pow(0.3L, static_cast<long double>(ms) / 100);
    EXPECT_EQ(gains_after(ms, kGainsByTime).free_mass,
              static_cast<int>(std::floor(32'768 * (1 - doubt))))
        << ms;
    EXPECT_EQ(gains_after(ms, kGainsByTime).hit_mass, 28'416);
  }
  EXPECT_EQ(gains_after(100, kGainsByTime).free_mass, 22'937);  // 0.7 of 2^15 is 22937.6
}

// Kurdej 2015, table 7.1, in steps of 1/128: 0.8 is 102.4, 0.7 is 89.6 of them.
TEST(FreeMass, OfAScanIsWhatItIs) {
  for (std::uint32_t ms = 0; ms <= 200; ++ms) {
    const evidence::Gains gains = gains_after(ms, kGainsOfScan);
    EXPECT_EQ(gains.hit_mass, 102 * 256);
    EXPECT_EQ(gains.free_mass, 89 * 256);
    EXPECT_EQ(gains.persistence, gains_after(ms, kGainsByTime).persistence);
  }
}

TEST(Gains, AreThoseOf1To100Milliseconds) {
  for (const GainsTable& table : {kGainsByTime, kGainsOfScan}) {
    EXPECT_EQ(gains_after(0, table), gains_after(1, table));
    EXPECT_EQ(gains_after(101, table), gains_after(100, table));
    EXPECT_EQ(gains_after(0xFFFF'FFFF, table), gains_after(100, table));
  }
}

// One frame of 40 ms.
TEST(Gains, OfOneFrame) {
  const evidence::Gains gains = gains_after(40, kGainsByTime);
  EXPECT_EQ(gains.persistence, 437);        // 436.9
  EXPECT_EQ(gains.decline, 2621);           // 2621.4
  EXPECT_EQ(gains.specialisation, 19'661);  // 19660.8
}

}  // namespace
}  // namespace iog::ageing
