// What a return is, at the limits of docs/ground.md.
#include "ground/judge.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace iog::ground {
namespace {

TEST(Judge, HasBothLimitsInside) {
  constexpr Limits kLimits{.low_mm = 250, .top_mm = 2'200};
  EXPECT_EQ(judge(kLimits, -401), Kind::kUnder);
  EXPECT_EQ(judge(kLimits, -400), Kind::kGround);
  EXPECT_EQ(judge(kLimits, 0), Kind::kGround);
  EXPECT_EQ(judge(kLimits, 249), Kind::kGround);
  EXPECT_EQ(judge(kLimits, 250), Kind::kObstacle);
  EXPECT_EQ(judge(kLimits, 2'200), Kind::kObstacle);
  EXPECT_EQ(judge(kLimits, 2'201), Kind::kOverhang);
  EXPECT_EQ(judge(kLimits, std::numeric_limits<std::int32_t>::min()), Kind::kUnder);
  EXPECT_EQ(judge(kLimits, std::numeric_limits<std::int32_t>::max()), Kind::kOverhang);
}

}  // namespace
}  // namespace iog::ground
