// Saturating addition: all 65,536 pairs, and the laws that make a frame independent of order.
#include "index/occupancy_index.hpp"

#include <gtest/gtest.h>

namespace iog::index {
namespace {

TEST(SaturatingAddition, EveryPairIsTheSumClampedTo127) {
  for (int a = -128; a <= 127; ++a) {
    for (int b = -128; b <= 127; ++b) {
      const int sum = a + b;
      const int clamped = sum > 127 ? 127 : (sum < -127 ? -127 : sum);
      ASSERT_EQ(int{sat_add(static_cast<OccupancyIndex>(a), static_cast<OccupancyIndex>(b))},
                clamped)
          << a << " + " << b;
    }
  }
}

TEST(SaturatingAddition, LoweringIsTheSameSum) {
  for (int a = -127; a <= 127; ++a) {
    for (int b = -127; b <= 0; ++b) {
      const auto x = static_cast<OccupancyIndex>(a);
      const auto y = static_cast<OccupancyIndex>(b);
      ASSERT_EQ(sat_lower(x, y), sat_add(x, y)) << a << " + " << b;
    }
  }
}

// A carved byte may go one below the range of an index.
TEST(SaturatingAddition, ACarvedByteIsRaisedToTheFloorOfAnIndex) {
  EXPECT_EQ(int{raised(-128)}, -127);
  for (int byte = -127; byte <= 127; ++byte) {
    ASSERT_EQ(int{raised(static_cast<std::int8_t>(byte))}, byte);
  }
}

// docs/model.md section 3: additions of one sign commute under saturation, in any grouping.
TEST(SaturatingAddition, IndexesOfOneSignGroupFreely) {
  for (int sign = -1; sign <= 1; sign += 2) {
    for (int a = 0; a <= 127; a += 3) {
      for (int b = 0; b <= 127; b += 2) {
        for (int c = 0; c <= 127; c += 5) {
          const auto x = static_cast<OccupancyIndex>(sign * a);
          const auto y = static_cast<OccupancyIndex>(sign * b);
          const auto z = static_cast<OccupancyIndex>(sign * c);
          ASSERT_EQ(sat_add(sat_add(x, y), z), sat_add(x, sat_add(y, z)));
          ASSERT_EQ(sat_add(x, y), sat_add(y, x));
        }
      }
    }
  }
}

}  // namespace
}  // namespace iog::index
