#include "pose/slice.hpp"

#include <gtest/gtest.h>

#include "fakes/random.hpp"

namespace iog::pose {
namespace {

TEST(Slice, IsEightMillisecondsLong) {
  const Slicing slicing;
  EXPECT_EQ(slicing.slice_of(0), (Slice{.number = 0, .middle_us = 4'000, .end_us = 8'000}));
  EXPECT_EQ(slicing.slice_of(7'999).number, 0U);
  EXPECT_EQ(slicing.slice_of(8'000), (Slice{.number = 1, .middle_us = 12'000, .end_us = 16'000}));
}

// The definition of the slice that holds a time, for each length that a description may choose.
TEST(Slice, HoldsItsTimeAroundItsMiddle) {
  tests::Random random(6);
  for (std::uint8_t log2_ms = 0; log2_ms <= 6; ++log2_ms) {
    const Slicing slicing(log2_ms);
    const std::uint64_t length = slicing.slice_us();
    ASSERT_EQ(length, 1'000U << log2_ms);
    for (int i = 0; i < 300; ++i) {
      const std::uint64_t time = random.next() >> random.between(1, 63);
      const Slice slice = slicing.slice_of(time);
      ASSERT_LE(slice.end_us - length, time);
      ASSERT_LT(time, slice.end_us);
      ASSERT_EQ(slice.middle_us, slice.end_us - length / 2);
      ASSERT_EQ(slice.number * length, slice.end_us - length);
    }
  }
}

TEST(Slice, TheLastTimesWrapAndHarmNothing) {
  EXPECT_EQ(Slicing().slice_of(~std::uint64_t{0}).number, ~std::uint64_t{0} / 8'000);
}

}  // namespace
}  // namespace iog::pose
