#include "tools/simulate/world/attitude.hpp"

#include <algorithm>
#include <cmath>
#include <deque>

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

constexpr double kDegree = 3.14159265358979 / 180;

TEST(Attitude, LeansByTwoDegreesAtMostAndByOneInATenthOfASecond) {
  for (std::uint64_t seed = 1; seed < 6; ++seed) {
    const Attitude attitude(seed);
    double most = 0;
    double most_roll = 0;
    double fastest = 0;
    std::deque<Lean> last;  // of 100 ms
    for (int ms = 0; ms < 60'000; ms += 2) {
      const Lean lean = attitude.at(ms / 1000.0);
      most = std::max(most, std::abs(lean.pitch));
      most_roll = std::max(most_roll, std::abs(lean.roll));
      for (const Lean& before : last) {
        fastest = std::max(
            {fastest, std::abs(lean.pitch - before.pitch), std::abs(lean.roll - before.roll)});
      }
      last.push_back(lean);
      if (last.size() > 50) {
        last.pop_front();
      }
    }
    EXPECT_LT(most, 2 * kDegree) << seed;
    EXPECT_GT(most, 1.2 * kDegree) << seed;
    EXPECT_GT(most_roll, 0.8 * kDegree) << seed;
    EXPECT_LT(fastest, 1 * kDegree) << seed;
    EXPECT_GT(fastest, 0.7 * kDegree) << seed;
  }
}

TEST(Attitude, IsOfItsSeedAndWithoutJumps) {
  const Attitude one(1);
  EXPECT_EQ(one.at(7.3).pitch, Attitude(1).at(7.3).pitch);
  bool differs = false;
  for (double time_s = 0; time_s < 60; time_s += 0.001) {
    differs = differs || one.at(time_s).roll != Attitude(2).at(time_s).roll;
    EXPECT_NEAR(one.at(time_s).pitch, one.at(time_s + 0.001).pitch, 0.0006) << time_s;
    EXPECT_NEAR(one.at(time_s).heave_m, one.at(time_s + 0.001).heave_m, 0.001) << time_s;
  }
  EXPECT_TRUE(differs);
}

}  // namespace
}  // namespace iog::tools
