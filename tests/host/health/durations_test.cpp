// What is remembered of how long something took: worst, sum, and the octave of each.
#include "health/durations.hpp"

#include <gtest/gtest.h>
#include <limits>

namespace iog::health {
namespace {

constexpr std::uint32_t kMost = std::numeric_limits<std::uint32_t>::max();

TEST(Durations, BeginWithNothing) {
  const Durations durations;
  EXPECT_EQ(durations.worst_us, 0U);
  EXPECT_EQ(durations.sum_us(), 0U);
}

// docs/spec.md 3.7: below 256 us, below twice that, ..., from 65,536 us on.
TEST(Durations, CountInOctaves) {
  Durations durations;
  constexpr std::array<std::uint32_t, 11> kTimes{0,     255,    256,    511,    512,  1'023,
                                                 1'024, 32'768, 65'535, 65'536, kMost};
  for (const std::uint32_t us : kTimes) {
    durations.add(us);
  }
  EXPECT_EQ(durations.counts,
            (std::array<std::uint32_t, Durations::kBuckets>{2, 2, 2, 1, 0, 0, 0, 0, 2, 2}));
}

TEST(Durations, RememberTheWorstAndTheSum) {
  Durations durations;
  constexpr std::array<std::uint32_t, 4> kTimes{7, kMost, kMost, 9};
  for (const std::uint32_t us : kTimes) {
    durations.add(us);
  }
  EXPECT_EQ(durations.worst_us, kMost);
  EXPECT_EQ(durations.sum_us(), 2 * std::uint64_t{kMost} + 16);
}

}  // namespace
}  // namespace iog::health
