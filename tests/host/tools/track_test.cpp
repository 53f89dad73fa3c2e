#include "tools/clouds/track.hpp"

#include <algorithm>
#include <iterator>

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

// A typing error in a time makes a silence of 88 years; the grid of times goes on behind it.
TEST(Track, PassesOverASilenceOfYears) {
  constexpr std::uint64_t kLongUs = 2'777'000'000'000'000;
  PoseLog log;
  for (const std::uint64_t time_us :
       {std::uint64_t{0}, std::uint64_t{500'000}, kLongUs + 5'000, kLongUs + 25'000}) {
    log.poses.push_back({.time_us = time_us, .heading_rad = 0});
  }
  std::vector<std::uint64_t> times;
  std::ranges::transform(Track(log).every(10'000), std::back_inserter(times), &LoggedPose::time_us);
  ASSERT_EQ(times.size(), 51U + 2U);
  EXPECT_EQ(times[50], 500'000U);
  EXPECT_EQ(times[51], kLongUs + 10'000);
  EXPECT_EQ(times[52], kLongUs + 20'000);
}

}  // namespace
}  // namespace iog::tools
