#include "tools/frames/chosen_frame.hpp"

#include <gtest/gtest.h>

namespace iog::tools {
namespace {

GridFrame frame_of(std::uint64_t number, unsigned complete, unsigned partial) {
  GridFrame frame;
  frame.evidence_number = number;
  frame.header.complete_sensors = static_cast<std::uint8_t>(complete);
  frame.header.partial_sensors = static_cast<std::uint8_t>(partial);
  return frame;
}

TEST(ChosenFrame, IsTheLastWholeOne) {
  ChosenFrame chosen;
  EXPECT_FALSE(chosen.get());
  chosen.offer(frame_of(0, 0, 1));  // begins within a turn
  EXPECT_EQ(chosen.get()->evidence_number, 0U);
  for (std::uint64_t number = 1; number <= 3; ++number) {
    chosen.offer(frame_of(number, 1, 0));
  }
  chosen.offer(frame_of(4, 0, 1));  // and ends within one
  chosen.offer(frame_of(0, 0, 0));  // silence
  EXPECT_EQ(chosen.get()->evidence_number, 3U);
}

// A sensor that is silent all the time leaves no frame with all of them.
TEST(ChosenFrame, HasAsManyWholeScansAsAnyOther) {
  ChosenFrame chosen;
  chosen.offer(frame_of(0, 0b0111, 0));
  chosen.offer(frame_of(1, 0b0111, 0));
  chosen.offer(frame_of(2, 0b0011, 0b0100));
  EXPECT_EQ(chosen.get()->evidence_number, 1U);
}

TEST(ChosenFrame, IsTheOneThatWasAskedForHoweverPoor) {
  ChosenFrame chosen(2);
  for (std::uint64_t number = 0; number < 4; ++number) {
    chosen.offer(frame_of(number, number == 2 ? 0 : 1, 1));
  }
  EXPECT_EQ(chosen.get()->evidence_number, 2U);
}

}  // namespace
}  // namespace iog::tools
