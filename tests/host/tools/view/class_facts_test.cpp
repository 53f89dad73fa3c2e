// What a page is told of a frame's place.
#include <optional>
#include <string>

#include "gtest/gtest.h"

#include "page_reader.hpp"
#include "tools/view/viewer.hpp"

namespace iog::tools::view {
namespace {

constexpr std::size_t kLate = 1;  // docs/spec.md 5.5
constexpr std::size_t kJump = 4;

ClassGrid grid_with(std::uint32_t late_slices) {
  ClassGrid grid;
  grid.has_end = true;
  std::get<kLate>(grid.end.causes).slices = late_slices;
  grid.valid_tiles.set();
  return grid;
}

TEST(ClassFacts, SlicesWithoutAPlaceAreThoseSinceTheFrameBefore) {
  const LiveClasses classes;
  const ClassFacts first = class_facts_of(grid_with(7), classes, nullptr);
  EXPECT_EQ(first.not_placed.at(kLate), 0U);  // since when is not known
  const ClassFacts second = class_facts_of(grid_with(12), classes, &first);
  EXPECT_EQ(second.not_placed.at(kLate), 5U);
  EXPECT_EQ(second.not_placed.at(kJump), 0U);
  const ClassFacts anew = class_facts_of(grid_with(2), classes, &second);
  EXPECT_EQ(anew.not_placed.at(kLate), 0U);
}

TEST(ClassFacts, AFrameWithoutItsEndHasNone) {
  const LiveClasses classes;
  const ClassFacts before = class_facts_of(grid_with(7), classes, nullptr);
  ClassGrid grid = grid_with(12);
  grid.has_end = false;
  grid.valid_tiles.reset(3);
  const ClassFacts facts = class_facts_of(grid, classes, &before);
  EXPECT_FALSE(facts.end || facts.is_whole);
  EXPECT_EQ(facts.missing_tiles, 1U);
  EXPECT_EQ(class_facts_of(grid_with(20), classes, &facts).not_placed.at(kLate), 0U);
}

// Beside the pose a page is told whether it is one.
TEST(ClassFacts, APoseThatIsNotKnownIsNoPlace) {
  for (const bool is_known : {true, false}) {
    GridFrame frame;
    frame.classes = grid_with(0);
    frame.classes->window.slices = 5;
    if (is_known) {
      frame.classes->window.sigma = {20, 30};
    }
    const StreamHealth health;
    const FrameAssembler assembler([](const GridFrame& /*frame*/) {});
    const Recorder recorder("", 15000);
    std::optional<FrameFacts> facts = facts_of(frame, LiveGrid(), 0);
    facts->classes = class_facts_of(*frame.classes, LiveClasses(), nullptr);
    const std::string words = status_json({.health = &health,
                                           .assembler = &assembler,
                                           .recorder = &recorder,
                                           .frame = &facts,
                                           .source = "",
                                           .kind = "",
                                           .block = "",
                                           .problem = ""});
    EXPECT_NE(words.find(is_known ? R"("has_place":true)" : R"("has_place":false)"),
              std::string::npos);
  }
}

// A grid that no one sends is not missing.
TEST(FrameFacts, AStreamOfClassesAloneMissesNoIndexTiles) {
  GridFrame frame;
  frame.header.flags = stream::kFlagClasses | stream::kFlagNoIndexes;
  EXPECT_EQ(facts_of(frame, LiveGrid(), 0).missing_tiles, 0U);
  frame.header.flags = stream::kFlagClasses;
  EXPECT_EQ(facts_of(frame, LiveGrid(), 0).missing_tiles, geometry::kTileCount);
}

}  // namespace
}  // namespace iog::tools::view
