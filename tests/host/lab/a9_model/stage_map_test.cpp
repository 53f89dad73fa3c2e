// Which instructions a stage has, of a program that arm-none-eabi-g++ made (staged.cpp).
#include "lab/a9_model/stage_map.hpp"

#include <gtest/gtest.h>
#include <map>
#include <stdexcept>

namespace iog::a9_model {
namespace {

constexpr std::uint32_t kBegin = 0x1000'8000;  // as it is linked
constexpr std::uint32_t kEnd = kBegin + 0x200;

TEST(StageMap, AFunctionIsFoundAlsoWhereItLiesInAnother) {
  const StageRule rules[] = {{"in", "a9_model/staged", "inner"},
                             {"out", "a9_model/staged", "outer"}};
  const StageMap map(IOG_STAGED_PROGRAM, rules);
  ASSERT_EQ(map.stages().size(), 3);
  EXPECT_EQ(map.stages()[1], "in");
  EXPECT_EQ(map.stages()[2], "out");
  std::map<std::uint32_t, int> instructions;        // by stage
  std::map<std::uint32_t, std::uint32_t> function;  // of a stage, the last
  for (std::uint32_t address = kBegin; address < kEnd; address += 4) {
    const Place place = map.at(address);
    ++instructions[place.stage];
    function[place.stage] = place.function != 0 ? place.function : function[place.stage];
  }
  EXPECT_EQ(instructions[1], 3);  // the nops
  EXPECT_GE(instructions[2], 5);  // two constants, two stores, a return
  EXPECT_EQ(function[1], function[2]);
  EXPECT_NE(function[0], function[2]);  // start
}

TEST(StageMap, WhatIsOutsideOfTheProgramIsInNoStage) {
  const StageRule rules[] = {{"in", "a9_model/staged", "inner"}};
  const StageMap map(IOG_STAGED_PROGRAM, rules);
  for (const std::uint32_t address : {0U, kBegin - 4, kEnd, 0xffff'fffcU}) {
    EXPECT_EQ(map.at(address).stage, 0);
    EXPECT_EQ(map.at(address).function, 0);
  }
}

TEST(StageMap, ThumbIsToldFromA32) {
  const StageRule rules[] = {{"narrow", "a9_model/staged", "narrow"}};
  const StageMap map(IOG_STAGED_PROGRAM, rules);
  for (std::uint32_t address = kBegin; address < kEnd; address += 4) {
    EXPECT_EQ(map.is_thumb(address), map.at(address).stage == 1) << std::hex << address;
  }
  EXPECT_FALSE(map.is_thumb(kBegin - 4));
  EXPECT_EQ(StageMap(IOG_STAGED_PROGRAM, {}).stages().size(), 1);
}

TEST(StageMap, AFunctionThatIsNowhereIsNoSilence) {
  const StageRule other_file[] = {{"in", "a9_model/other", "inner"}};
  EXPECT_THROW(StageMap(IOG_STAGED_PROGRAM, other_file), std::runtime_error);
  const StageRule other_name[] = {{"in", "a9_model/staged", "inne"}};
  EXPECT_THROW(StageMap(IOG_STAGED_PROGRAM, other_name), std::runtime_error);
  EXPECT_THROW(StageMap("/dev/null", other_name), std::runtime_error);
}

}  // namespace
}  // namespace iog::a9_model
