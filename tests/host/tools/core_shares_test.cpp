// How the cores have shared the work, as a frame's end says it.
#include <algorithm>
#include <array>
#include <gtest/gtest.h>

#include "tools/report/counters.hpp"

namespace iog::tools {
namespace {

// docs/spec.md 3.7: 7 counters of the network, 19 causes of drops, 3 of refusals, 5 of the port, 8
// of fragments, and then those of the cores.
constexpr std::size_t kBefore = 7 + 19 + 3 + 5 + 8;

stream::FrameEnd end_of(const std::array<std::uint32_t, 6>& of_cores) {
  stream::FrameEnd end{};
  std::ranges::copy(of_cores, end.link_counters.begin() + kBefore);
  end.link_counter_count = static_cast<std::uint8_t>(kBefore + of_cores.size());
  return end;
}

TEST(CoreShares, AreBehindTheOtherLinkCounters) {
  EXPECT_EQ(core_shares_of(end_of({4, 7, 100, 50, 30, 20})),
            (CoreShares{.at_work = 4, .for_lost = 7, .items = {100, 50, 30, 20}}));
}

TEST(CoreShares, OfATargetThatKnowsFewerCountersAreNone) {
  stream::FrameEnd end = end_of({4, 7, 100, 50, 30, 20});
  --end.link_counter_count;
  EXPECT_EQ(core_shares_of(end), std::nullopt);
  EXPECT_EQ(core_shares_of(stream::FrameEnd{}), std::nullopt);
}

TEST(CoreShares, InWords) {
  EXPECT_EQ(words_of({.at_work = 4, .items = {100, 50, 30, 20}}),
            "4, with 50, 25, 15, 10 % of the shared items");
  EXPECT_EQ(words_of({.at_work = 3, .for_lost = 2, .items = {3, 1, 0, 0}}),
            "3, with 75, 25, 0, 0 % of the shared items, 2 done for lost cores");
  EXPECT_EQ(words_of({.at_work = 1, .items = {9, 0, 0, 0}}), "1");
  EXPECT_EQ(words_of({.at_work = 4}), "4");
}

}  // namespace
}  // namespace iog::tools
