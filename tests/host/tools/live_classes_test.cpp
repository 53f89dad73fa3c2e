// What a receiver shows of the world while the window moves and messages are lost.
#include "tools/frames/live_classes.hpp"

#include <algorithm>
#include <cstring>

#include "gtest/gtest.h"

#include "fake_class_target.hpp"
#include "tools/frames/frame_assembler.hpp"

namespace iog::tools {
namespace {

using Messages = FakeClassTarget::Messages;

constexpr std::uint32_t kRun = 7;
const FakeClassWorld kWorld{.seed = 3};

// A receiver of messages, frame by frame. The assembler hands over what has come of a frame when it
// is told that nothing more comes.
class Receiver {
 public:
  void take(const Messages& messages) {
    for (const auto& message : messages) {
      assembler_.take(message);
    }
    assembler_.finish();
  }
  [[nodiscard]] LiveClasses& live() { return live_; }

 private:
  LiveClasses live_;
  FrameAssembler assembler_{[this](const GridFrame& frame) { live_.take(frame); }};
};

std::size_t shown_tiles(const LiveClasses& live) {
  std::size_t shown = 0;
  for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
    shown += live.age_of(slot) ? 1U : 0U;
  }
  return shown;
}

// Of a world that is `frame` frames old: tiles that are shown, and are not what was there when they
// are said to have come.
std::size_t wrong_tiles(const LiveClasses& live, std::uint32_t frame,
                        const FakeClassWorld& world = kWorld) {
  std::size_t wrong = 0;
  for (const FakeClassWorld::Place& place : world.window_in(frame)) {
    const auto age = live.age_of(place.slot);
    const auto cells = age ? world.at(place.a, place.b, frame - *age) : std::nullopt;
    const auto expected = cells.value_or(FakeClassWorld::Cells{});
    bool is_right =
        std::memcmp(live.tile(place.slot).data(), expected.data(), expected.size()) == 0;
    if (cells) {
      const std::uint8_t decided = FakeClassWorld::age_of(place.number, frame - *age);
      is_right = is_right && live.decided_ago(place.slot) == decided + *age;
    }
    wrong += is_right ? 0U : 1U;
  }
  return wrong;
}

// The messages of a frame but for its first one with tiles of classes, or but for all of classes.
Messages without_a_part(Messages messages) {
  const auto is_class_end = [](const auto& message) {
    return message.at(protection::kProtectionBytes) ==
           static_cast<std::byte>(stream::MessageType::kClassEnd);
  };
  // Tiles of classes are before their end.
  const auto end = std::ranges::find_if(messages, is_class_end);
  messages.erase(end - 1);
  return messages;
}

TEST(LiveClasses, TilesKeepTheirNumberWhileTheWindowMoves) {
  FakeClassTarget target(kWorld, kRun);
  Receiver receiver;
  for (std::uint32_t frame = 0; frame < 12; ++frame) {
    receiver.take(target.next());
    EXPECT_EQ(receiver.live().stale_tiles(), 0U);
    EXPECT_EQ(wrong_tiles(receiver.live(), frame), 0U);
    ASSERT_TRUE(receiver.live().window().has_value());
    EXPECT_EQ(receiver.live().window()->corner_a, FakeClassWorld::corner_in(frame).first);
  }
}

TEST(LiveClasses, WhatIsLostIsStaleAndGoesWhenItLeavesTheWindow) {
  FakeClassTarget target(kWorld, kRun);
  Receiver receiver;
  receiver.take(target.next());
  for (std::uint32_t frame = 1; frame < 40; ++frame) {
    receiver.take(without_a_part(target.next()));
    EXPECT_GT(receiver.live().stale_tiles(), 0U);
    EXPECT_EQ(wrong_tiles(receiver.live(), frame), 0U);
  }
  // The window has moved by 19 and 13 tiles.
  EXPECT_LT(shown_tiles(receiver.live()), geometry::kTileCount);
}

TEST(LiveClasses, NothingIsKeptWhenTheTargetHasLostItsWay) {
  for (const std::uint16_t cause : {stream::kCauseLost, stream::kCauseJump, stream::kCauseRestart,
                                    stream::kCauseContradicted, stream::kCauseDrifting}) {
    FakeClassTarget target(kWorld, kRun);
    Receiver receiver;
    receiver.take(target.next());
    receiver.take(without_a_part(target.next(cause)));
    EXPECT_LT(shown_tiles(receiver.live()), geometry::kTileCount) << cause;
    EXPECT_EQ(shown_tiles(receiver.live()) + receiver.live().stale_tiles(), geometry::kTileCount);
  }
  for (const std::uint16_t cause :
       {stream::kCauseLate, stream::kCauseImprecise, stream::kCauseOverBudget}) {
    FakeClassTarget target(kWorld, kRun);
    Receiver receiver;
    receiver.take(target.next());
    receiver.take(without_a_part(target.next(cause)));
    EXPECT_EQ(shown_tiles(receiver.live()), geometry::kTileCount) << cause;
  }
}

// It may have lost its way in the frame that nobody has heard of.
TEST(LiveClasses, NothingIsKeptOverAFrameOfWhichNothingCame) {
  FakeClassTarget target(kWorld, kRun);
  Receiver receiver;
  receiver.take(target.next());
  static_cast<void>(target.next(stream::kCauseJump));
  receiver.take(without_a_part(target.next()));
  EXPECT_LT(shown_tiles(receiver.live()), geometry::kTileCount);
  EXPECT_EQ(wrong_tiles(receiver.live(), 2), 0U);
}

TEST(LiveClasses, NothingIsKeptOfAFrameWhoseClassesAreAllLost) {
  FakeClassTarget target(kWorld, kRun);
  Receiver receiver;
  receiver.take(target.next());
  const Messages messages = target.next(stream::kCauseJump);
  receiver.take({messages.back()});
  EXPECT_EQ(shown_tiles(receiver.live()), 0U);
  EXPECT_FALSE(receiver.live().window().has_value());
}

TEST(LiveClasses, NothingIsKeptOfAnotherRun) {
  FakeClassTarget first(kWorld, kRun);
  FakeClassTarget second({.seed = 4}, kRun + 1);
  Receiver receiver;
  receiver.take(first.next());
  static_cast<void>(second.next());
  receiver.take(without_a_part(second.next()));  // its number would be the next
  EXPECT_LT(shown_tiles(receiver.live()), geometry::kTileCount);
}

TEST(LiveClasses, AfterASilenceNothingIsKnown) {
  FakeClassTarget target(kWorld, kRun);
  Receiver receiver;
  receiver.take(target.next());
  receiver.live().forget();
  EXPECT_EQ(shown_tiles(receiver.live()), 0U);
  EXPECT_EQ(receiver.live().stale_tiles(), geometry::kTileCount);
  receiver.take(without_a_part(target.next()));
  EXPECT_LT(shown_tiles(receiver.live()), geometry::kTileCount) << "what was forgotten stays so";
}

// Any messages lost, and causes at any time: nothing from before a cause is shown, and nothing in a
// place where it was not.
TEST(LiveClasses, NothingThatIsShownIsWrong) {
  for (std::uint64_t seed = 0; seed < 3; ++seed) {
    tests::Random random(seed);
    FakeClassTarget target(kWorld, kRun);
    Receiver receiver;
    std::uint32_t last_cause = 0;
    for (std::uint32_t frame = 0; frame < 20; ++frame) {
      const bool has_cause = random.one_in(6);
      last_cause = has_cause ? frame : last_cause;
      Messages messages = target.next(has_cause ? stream::kCauseJump : std::uint16_t{0});
      std::erase_if(messages, [&](const auto&) { return random.one_in(frame % 5 == 4 ? 2 : 10); });
      receiver.take(messages);
      if (messages.empty()) {
        continue;  // the newest frame is an older one
      }
      EXPECT_EQ(wrong_tiles(receiver.live(), frame), 0U);
      for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
        EXPECT_LE(receiver.live().age_of(slot).value_or(0), frame - last_cause);
      }
    }
  }
}

// Tiles outside a window of 12 by 7 tiles are not shown, also those that have just left it.
TEST(LiveClasses, AWindowMayBeARectangle) {
  const FakeClassWorld world{.seed = 5, .extent = {.columns = 12, .rows = 7}};
  FakeClassTarget target(world, kRun);
  Receiver receiver;
  for (std::uint32_t frame = 0; frame < 12; ++frame) {
    const bool is_lossy = frame % 3 == 1;
    receiver.take(is_lossy ? without_a_part(target.next()) : target.next());
    EXPECT_EQ(wrong_tiles(receiver.live(), frame, world), 0U) << frame;
    EXPECT_EQ(receiver.live().extent(), world.extent);
    EXPECT_TRUE(!is_lossy || receiver.live().stale_tiles() > 0) << frame;
    EXPECT_LE(shown_tiles(receiver.live()), 12U * 7U);
    if (frame == 0) {
      EXPECT_EQ(receiver.live().stale_tiles(), 0U);
      EXPECT_EQ(shown_tiles(receiver.live()), 12U * 7U);
    }
  }
}

}  // namespace
}  // namespace iog::tools
