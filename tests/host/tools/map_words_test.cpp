// What a target says of its map, in words and for a script.
#include "tools/report/map_words.hpp"

#include <algorithm>
#include <gtest/gtest.h>

namespace iog::tools {
namespace {

stream::MapState state_in_use() {
  stream::MapState state;
  state.in_use.emplace().source = 1;
  state.in_use->set_words("\u00A9 nobody");
  state.layer.crc = 0x1A2B3C4D;
  state.layer.cause = map::Cause::kNone;
  state.layer.tiles_drawn = 1'000;
  state.layer.tiles_waiting = 24;
  state.layer.radius = 9;
  return state;
}

std::string fact_of_map(const stream::MapState& state, const std::string& name) {
  const auto facts = map_facts(state);
  const auto found = std::ranges::find(facts, name, [](const auto& pair) { return pair.first; });
  return found == facts.end() ? "missing" : found->second;
}

TEST(MapWords, OfAMapInUseItsNameAndWhoseItIs) {
  const std::string table = map_table(state_in_use());
  EXPECT_NE(table.find("1a2b3c4d, \u00A9 nobody"), std::string::npos) << table;
  EXPECT_NE(table.find("1000 drawn, 24 waiting"), std::string::npos) << table;
  EXPECT_EQ(fact_of_map(state_in_use(), "map_crc"), "1a2b3c4d");
  EXPECT_EQ(fact_of_map(state_in_use(), "map_attribution"), "\u00A9 nobody");
  EXPECT_EQ(fact_of_map({}, "map_crc"), "none");
}

TEST(MapWords, WhatCommandsATerminalDoesNotReachIt) {
  stream::MapState state = state_in_use();
  state.in_use->set_words("a\x1b[2Jb\x7f\n");
  EXPECT_EQ(name_of_map(state), "1a2b3c4d, a?[2Jb??");
  state.in_use->set_words("a\u009B2Jb");  // CSI as one character, ISO 6429
  EXPECT_EQ(name_of_map(state).find('\x9B'), std::string::npos);
}

TEST(MapWords, EachCauseHasItsWordsAndOneOfTomorrowToo) {
  EXPECT_TRUE(words_of(map::Cause::kNone).empty());
  for (std::size_t cause = 1; cause < map::kCauseCount + 2; ++cause) {
    EXPECT_FALSE(words_of(static_cast<map::Cause>(cause)).empty()) << cause;
  }
  stream::MapState state = state_in_use();
  state.layer.cause = map::Cause::kOtherOrigin;
  EXPECT_NE(map_table(state).find(words_of(map::Cause::kOtherOrigin)), std::string::npos);
}

TEST(MapWords, SaysWhatIsOnItsWayAndWhatWasRefused) {
  stream::MapState state;
  EXPECT_TRUE(words_of_delivery(state.delivery).empty());
  state.delivery.state = map::DeliveryState::kReceiving;
  state.delivery.incoming = {.crc = 0x5E6F7081, .bytes = 1'281};
  state.delivery.chunks_there = 1;
  EXPECT_EQ(words_of_delivery(state.delivery), "receiving 5e6f7081, 1 of 2 chunks");
  state.delivery.blocks_refused = 2;
  state.delivery.last_refusal = map::Refusal::kDamaged;
  EXPECT_NE(map_table(state).find("2, the last: damaged"), std::string::npos);
  state.delivery.last_refusal = static_cast<map::Refusal>(200);
  EXPECT_NE(map_table(state).find("reason 200"), std::string::npos);
}

}  // namespace
}  // namespace iog::tools
