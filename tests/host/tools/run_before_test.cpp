// How the run before has ended, as a frame's end says it.
#include <gtest/gtest.h>

#include "tools/report/counters.hpp"

namespace iog::tools {
namespace {

// docs/spec.md 3.7: behind 42 counters of the network, 6 of the cores and 4 of the port.
constexpr std::size_t kEndsBefore = 42 + 6 + 4;

stream::FrameEnd end_with(std::uint32_t starts, std::uint32_t cause, std::uint32_t detail) {
  stream::FrameEnd end{};
  end.link_counters.at(kEndsBefore) = starts;
  end.link_counters.at(kEndsBefore + 1) = cause;
  end.link_counters.at(kEndsBefore + 2) = detail;
  end.link_counter_count = kEndsBefore + 3;
  return end;
}

std::string words(std::uint32_t starts, std::uint32_t cause, std::uint32_t detail) {
  return words_of(run_before_of(end_with(starts, cause, detail)).value());
}

TEST(EndOfTheRunBefore, InWords) {
  EXPECT_EQ(words(1, 0, 0), "1 since power-up");
  EXPECT_EQ(words(2, 1, 0), "2 since power-up; before: reset without a word");
  EXPECT_EQ(words(3, 2, 4), "3 since power-up; before: exception of the processor, kind 4");
  EXPECT_EQ(words(3, 3, 77), "3 since power-up; before: requirement broken, line 77");
  EXPECT_EQ(words(9, 4, 1), "9 since power-up; before: memory has changed, region 1");
  EXPECT_EQ(words(2, 5, 0x100), "2 since power-up; before: silent: core 2");
  EXPECT_EQ(words(2, 5, 0x441),
            "2 since power-up; before: silent: datagrams, Ethernet controller, number 10");
  EXPECT_EQ(words(2, 6, 0x10100014), "2 since power-up; before: hung at 0x10100014");
  EXPECT_EQ(words(9, 200, 1), "9 since power-up; before: cause 200, 1") << "of a later target";
}

TEST(EndOfTheRunBefore, OfATargetThatKnowsFewerCountersIsNone) {
  stream::FrameEnd end = end_with(2, 1, 0);
  --end.link_counter_count;
  EXPECT_EQ(run_before_of(end), std::nullopt);
}

}  // namespace
}  // namespace iog::tools
