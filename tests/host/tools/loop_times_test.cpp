// The loop's own times, as a frame's end says them.
#include <gtest/gtest.h>

#include "tools/report/counters.hpp"

namespace iog::tools {
namespace {

// docs/spec.md 3.7: behind 42 counters of the network, 6 of the cores, 4 of the port and 3 of the
// run before; each row has the worst, the sum in two words, and ten counts.
constexpr std::size_t kTimesBefore = 42 + 6 + 4 + 3;
constexpr std::size_t kRowCounters = 13;

stream::FrameEnd end_with_row(std::size_t number) {
  stream::FrameEnd end{};
  end.link_counter_count = kTimesBefore + 10 * kRowCounters;
  const std::size_t row = kTimesBefore + number * kRowCounters;
  end.link_counters.at(row) = 70'000;
  end.link_counters.at(row + 1) = 1;
  end.link_counters.at(row + 2) = 4;
  end.link_counters.at(row + 3) = 1'048'575;
  end.link_counters.at(row + 11) = 1;
  end.link_counters.at(row + 12) = 1'048'576;
  return end;
}

TEST(TimesOfTheLoop, AreRowsBehindTheOtherLinkCounters) {
  const auto times = loop_times_of(end_with_row(5));
  ASSERT_TRUE(times.has_value());
  const LoopTime& late = times->at(5);
  EXPECT_EQ(kLoopTimeNames.at(5), "late");
  EXPECT_EQ(late.worst_us, 70'000U);
  EXPECT_EQ(late.sum_us, (1ULL << 32) + 4);
  EXPECT_EQ(late.count(), 2'097'152U);
  EXPECT_EQ(times->at(4).count() + times->at(6).count(), 0U);
}

TEST(TimesOfTheLoop, InWords) {
  EXPECT_EQ(words_of(loop_times_of(end_with_row(9))->at(9)),
            "2048 us mean, 70000 worst, of 2097152: 50 % < 256, 0 % < 65536, 50 % >= 65536");
  EXPECT_EQ(words_of(LoopTime{}), "0 us mean, 0 worst, of 0");
}

TEST(TimesOfTheLoop, OfATargetThatKnowsFewerCountersAreNone) {
  stream::FrameEnd end = end_with_row(0);
  --end.link_counter_count;
  EXPECT_EQ(loop_times_of(end), std::nullopt);
}

}  // namespace
}  // namespace iog::tools
