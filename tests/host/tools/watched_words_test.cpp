// What is not watched, in degrees for a person: 64 sectors of 5.625, counter-clockwise from ahead.
#include <gtest/gtest.h>

#include "tools/report/words.hpp"

namespace iog::tools {
namespace {

TEST(UnwatchedSectors, InWords) {
  EXPECT_EQ(words_of_sectors(0), "none");
  EXPECT_EQ(words_of_sectors(~std::uint64_t{0}), "all around");
  EXPECT_EQ(words_of_sectors(0x0000'0000'00FF'0000), "90 to 135 degrees");
  EXPECT_EQ(words_of_sectors(0x0000'FF00'00FF'0000), "90 to 135, -135 to -90 degrees");
}

TEST(UnwatchedSectors, AcrossAheadAndBehind) {
  EXPECT_EQ(words_of_sectors(0xF000'0000'0000'000F), "-23 to 23 degrees");
  EXPECT_EQ(words_of_sectors(0x0000'000F'F000'0000), "158 to -158 degrees");
  EXPECT_EQ(words_of_sectors(0x0000'0000'F000'0000), "158 to -180 degrees");
}

}  // namespace
}  // namespace iog::tools
