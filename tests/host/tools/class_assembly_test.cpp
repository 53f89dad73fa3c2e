// Frames with classes, put together from messages that a network has lost, mixed up, repeated and
// damaged: a tile that is shown is that of the world, whatever happened.
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <functional>
#include <map>
#include <vector>

#include "gtest/gtest.h"

#include "fake_class_target.hpp"
#include "tools/frames/frame_assembler.hpp"

namespace iog::tools {
namespace {

using Messages = FakeClassTarget::Messages;

constexpr std::uint32_t kFrames = 10;
constexpr std::size_t kContent = protection::kProtectionBytes;
constexpr std::uint32_t kRun = 7;
constexpr std::uint32_t kNextRun = 8;
constexpr std::uint32_t kRunOfRectangle = 9;

const FakeClassWorld kRectangle{.seed = 3, .extent = {.columns = 12, .rows = 7}};

const FakeClassWorld& world_of(std::uint32_t run) {
  static const std::map<std::uint32_t, FakeClassWorld> worlds{
      {kRun, {.seed = 1}}, {kNextRun, {.seed = 2}}, {kRunOfRectangle, kRectangle}};
  return worlds.at(run);
}

Messages run(std::uint32_t run_number, bool has_indexes = true) {
  return FakeClassTarget(world_of(run_number), run_number, has_indexes).frames(kFrames);
}

const Messages& sample() {
  static const Messages messages = run(kRun);
  return messages;
}

stream::MessageType type_of(const std::vector<std::byte>& message) {
  return static_cast<stream::MessageType>(message.at(kContent));
}
bool is_of_classes(const std::vector<std::byte>& message) {
  constexpr std::size_t kStorage = kContent + stream::kHeaderBytes + 7;
  return type_of(message) == stream::MessageType::kClassEnd ||
         (type_of(message) == stream::MessageType::kTiles &&
          message.at(kStorage) == static_cast<std::byte>(stream::Storage::kClass));
}

// Tiles that are valid and not those of the world.
std::size_t wrong_tiles(const GridFrame& frame) {
  const ClassGrid& classes = *frame.classes;
  const FakeClassWorld& world = world_of(frame.header.run_number);
  const std::uint32_t number = frame.header.frame_number;
  const auto corner = FakeClassWorld::corner_in(number);
  std::size_t wrong = 0;
  for (const FakeClassWorld::Place& place : world.window_in(number)) {
    const auto cells = world.at(place.a, place.b, number);
    const auto x = static_cast<std::size_t>(place.a - corner.first) * 32;
    const auto y = static_cast<std::size_t>(place.b - corner.second) * 32;
    const bool is_valid = classes.valid_tiles.test(place.slot);
    bool is_right = classes.known_tiles.test(place.slot) == (is_valid && cells.has_value());
    if (is_right && classes.known_tiles.test(place.slot)) {
      is_right = classes.age_frames.at(place.slot) == FakeClassWorld::age_of(place.number, number);
    }
    const auto expected = is_valid && cells ? *cells : FakeClassWorld::Cells{};
    for (std::size_t row = 0; row < 32 && is_right; ++row) {
      is_right = std::memcmp(&classes.cells[(y + row) * 1024 + x], &expected[32 * row], 32) == 0;
    }
    wrong += is_right ? 0U : 1U;
  }
  for (std::size_t i = 0; i < classes.cells.size(); ++i) {
    const bool is_inside =
        i % 1024 / 32 < world.extent.columns && i / 1024 / 32 < world.extent.rows;
    wrong += !is_inside && classes.cells[i] != 0 ? 1U : 0U;
  }
  return wrong;
}

struct Outcome {
  std::vector<std::uint32_t> frames;
  std::size_t whole = 0;  // both grids
  std::size_t damaged = 0;
  std::size_t valid_tiles = 0;
  MessageCounts counts;
};

Outcome assemble(const Messages& messages) {
  Outcome outcome;
  std::size_t wrong = 0;
  FrameAssembler assembler([&](const GridFrame& frame) {
    outcome.frames.push_back(frame.header.frame_number);
    ASSERT_TRUE(frame.classes.has_value());
    outcome.whole += frame.is_whole() && frame.classes->is_whole() ? 1U : 0U;
    outcome.damaged += frame.classes->is_damaged ? 1U : 0U;
    outcome.valid_tiles += frame.classes->valid_tiles.count();
    wrong += wrong_tiles(frame);
  });
  for (const auto& message : messages) {
    assembler.take(message);
  }
  assembler.finish();
  outcome.counts = assembler.counts();
  EXPECT_EQ(outcome.counts.datagrams(), messages.size()) << "each has one fate";
  EXPECT_EQ(wrong, 0U);
  return outcome;
}

// Changes what `change` wants and protects all once more, by a sender that means well.
Messages changed(Messages messages, const std::function<void(Messages&)>& change) {
  change(messages);
  protection::Sender sender(stream::kNetworkChannel);
  for (auto& message : messages) {
    sender.protect(message);
  }
  return messages;
}

std::size_t first_of_classes(const Messages& messages) {
  return static_cast<std::size_t>(std::ranges::find_if(messages, is_of_classes) - messages.begin());
}
std::size_t first_class_end(const Messages& messages) {
  return static_cast<std::size_t>(
      std::ranges::find(messages, stream::MessageType::kClassEnd, type_of) - messages.begin());
}

TEST(ClassAssembly, FramesHaveBothGrids) {
  const Outcome outcome = assemble(sample());
  EXPECT_EQ(outcome.frames.size(), kFrames);
  EXPECT_EQ(outcome.whole, kFrames);
  EXPECT_EQ(outcome.valid_tiles, kFrames * geometry::kTileCount);
  EXPECT_EQ(outcome.counts.messages, sample().size());
  EXPECT_EQ(outcome.counts.tiles, kFrames * FakeClassTarget::kKnownIndexTiles);
}

// A window of 12 by 7 tiles, which moves over multiples of both.
TEST(ClassAssembly, AWindowMayBeARectangle) {
  const Messages all = run(kRunOfRectangle);
  const Outcome outcome = assemble(all);
  EXPECT_EQ(outcome.whole, kFrames);
  EXPECT_EQ(outcome.damaged, 0U);
  EXPECT_EQ(outcome.counts.messages, all.size());
  for (std::size_t lost = 0; lost < 5; ++lost) {
    Messages some;
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (i % 5 != lost) {
        some.push_back(all[i]);
      }
    }
    EXPECT_LT(assemble(some).whole, kFrames);
  }
}

TEST(ClassAssembly, AFrameMayHaveClassesAlone) {
  const Outcome outcome = assemble(run(kRun, false));
  EXPECT_EQ(outcome.whole, kFrames);
  EXPECT_EQ(outcome.counts.tiles, 0U);
}

// Of a frame with both grids any message may be the last.
TEST(ClassAssembly, AFrameWaitsForBothGrids) {
  const Messages frame = FakeClassTarget(world_of(kRun), kRun).next();
  for (std::size_t last = 0; last < frame.size(); ++last) {
    std::size_t frames = 0;
    FrameAssembler assembler([&](const GridFrame& shown) {
      ++frames;
      EXPECT_TRUE(shown.is_whole() && shown.classes->is_whole());
    });
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (i != last) {
        assembler.take(frame[i]);
      }
    }
    EXPECT_EQ(frames, 0U) << last;
    assembler.take(frame[last]);
    EXPECT_EQ(frames, 1U) << last;
  }
}

TEST(ClassAssembly, ALostMessageIsMissedInItsGridAlone) {
  for (const std::size_t lost : {first_of_classes(sample()), first_class_end(sample())}) {
    std::size_t whole_indexes = 0;
    std::size_t whole_classes = 0;
    FrameAssembler assembler([&](const GridFrame& frame) {
      whole_indexes += frame.is_whole() ? 1U : 0U;
      whole_classes += frame.classes->is_whole() ? 1U : 0U;
    });
    for (std::size_t i = 0; i < sample().size(); ++i) {
      if (i != lost) {
        assembler.take(sample()[i]);
      }
    }
    assembler.finish();
    EXPECT_EQ(whole_indexes, kFrames);
    EXPECT_LT(whole_classes, kFrames);
  }
}

TEST(ClassAssembly, RepeatedMessagesChangeNothing) {
  Messages messages;
  for (const auto& message : sample()) {
    messages.insert(messages.end(), 2, message);
  }
  EXPECT_EQ(assemble(messages).whole, kFrames);
}

TEST(ClassAssembly, OrderWithinReachChangesNothing) {
  Messages messages = sample();
  tests::Random random(99);
  for (std::size_t i = 1; i < messages.size(); ++i) {
    std::swap(messages[i], messages[i - random.below(std::min<std::size_t>(i, 8))]);
  }
  const Outcome outcome = assemble(messages);
  EXPECT_EQ(outcome.whole, kFrames);
  EXPECT_GT(outcome.counts.late, 0U);
}

// Losses, repetitions and disorder at once; assemble() looks at every tile.
TEST(ClassAssembly, WhateverTheNetworkDoesNoTileIsWrong) {
  tests::Random random(4711);
  for (int round = 0; round < 10; ++round) {
    Messages messages;
    for (const auto& message : sample()) {
      messages.insert(messages.end(), random.one_in(5) ? 0 : random.one_in(5) ? 2 : 1, message);
    }
    for (std::size_t i = 1; i < messages.size(); ++i) {
      std::swap(messages[i], messages[i - random.below(std::min<std::size_t>(i, 40))]);
    }
    const Outcome outcome = assemble(messages);
    EXPECT_TRUE(std::ranges::is_sorted(outcome.frames));
    EXPECT_LT(outcome.whole, kFrames);
    EXPECT_GT(outcome.valid_tiles, 0U);
  }
}

TEST(ClassAssembly, NoTileIsOfAnotherRun) {
  const Messages first = run(kRun);
  const Messages second = run(kNextRun);
  const auto half = static_cast<std::ptrdiff_t>(first.size() / 2);
  Messages messages(first.begin(), first.begin() + half);
  for (std::size_t i = 0; i < second.size(); ++i) {
    messages.push_back(second[i]);
    if (i > 3) {  // late, and repeated
      messages.push_back(first[i % first.size()]);
    }
  }
  const Outcome outcome = assemble(messages);
  EXPECT_EQ(outcome.counts.restarts, 1U);
  EXPECT_GE(outcome.whole, kFrames);
}

TEST(ClassAssembly, AllMessagesOfAFrameAgreeOnItsWindow) {
  for (const std::size_t at : {first_of_classes(sample()) + 1, first_class_end(sample())}) {
    const Messages messages = changed(sample(), [&](Messages& all) {
      const bool is_end = type_of(all[at]) == stream::MessageType::kClassEnd;
      const std::size_t window =
          kContent + stream::kHeaderBytes + (is_end ? std::size_t{0} : stream::kTilesHeaderBytes);
      all[at][window + 7] ^= std::byte{1};  // a
    });
    const Outcome outcome = assemble(messages);
    EXPECT_EQ(outcome.counts.malformed, 1U);
    EXPECT_LT(outcome.whole, kFrames);
  }
}

TEST(ClassAssembly, AllMessagesOfAFrameAgreeOnItsGrids) {
  constexpr std::size_t kFlags = kContent + 1;
  for (const std::uint8_t flag : {stream::kFlagClasses, stream::kFlagNoIndexes}) {
    const Messages messages = changed(
        sample(), [&](Messages& all) { all[first_of_classes(all)][kFlags] ^= std::byte{flag}; });
    EXPECT_EQ(assemble(messages).counts.malformed, 1U);
  }
}

TEST(ClassAssembly, AGridThatTheFrameHasNotIsNotBelieved) {
  constexpr std::size_t kFlags = kContent + 1;
  const Messages without_classes = changed(sample(), [](Messages& all) {
    for (auto& message : all) {
      message[kFlags] = std::byte{0};
    }
  });
  std::size_t frames = 0;
  FrameAssembler assembler([&](const GridFrame& frame) {
    ++frames;
    EXPECT_TRUE(frame.is_whole());
    EXPECT_FALSE(frame.classes.has_value());
  });
  for (const auto& message : without_classes) {
    assembler.take(message);
  }
  assembler.finish();
  EXPECT_EQ(frames, kFrames);
  EXPECT_EQ(assembler.counts().malformed + assembler.counts().too_late,
            static_cast<std::uint64_t>(std::ranges::count_if(sample(), is_of_classes)));

  const Messages without_indexes = changed(sample(), [](Messages& all) {
    for (auto& message : all) {
      message[kFlags] = std::byte{stream::kFlagClasses | stream::kFlagNoIndexes};
    }
  });
  const Outcome outcome = assemble(without_indexes);
  EXPECT_EQ(outcome.counts.tiles, 0U);
  EXPECT_GE(outcome.counts.malformed, kFrames);
}

// A tile's payload begins behind the header of the first tile of the first message; raw and run
// length alike have a value of a cell near its begin.
TEST(ClassAssembly, ATileWithABytesThatIsNoClassIsDropped) {
  constexpr std::size_t kTile =
      kContent + stream::kHeaderBytes + stream::kTilesHeaderBytes + stream::kClassWindowBytes;
  constexpr std::size_t kValue = kTile + stream::kClassTileRecordBytes + 1;
  for (const int byte : {1, 7, 72, 127, 200}) {
    const Messages messages = changed(sample(), [&](Messages& all) {
      all[first_of_classes(all)][kValue] = static_cast<std::byte>(byte);
    });
    const Outcome outcome = assemble(messages);
    EXPECT_EQ(outcome.counts.tiles_malformed, 1U) << byte;
    EXPECT_GE(outcome.counts.without_reference, 1U) << "later ones do not refer to it";
    EXPECT_LT(outcome.whole, kFrames);
    EXPECT_EQ(outcome.damaged, 0U);
  }
}

// One cell of a tile is another class: every message is sound, and the grid is not the target's.
TEST(ClassAssembly, AGridThatIsNotTheTargetsIsNotShown) {
  constexpr std::size_t kName = kContent + stream::kHeaderBytes + stream::kClassWindowBytes + 8;
  const Messages messages =
      changed(sample(), [](Messages& all) { all[first_class_end(all)][kName] ^= std::byte{1}; });
  std::size_t damaged = 0;
  FrameAssembler assembler([&](const GridFrame& frame) {
    EXPECT_TRUE(frame.is_whole()) << "the other grid is";
    if (frame.classes->is_damaged) {
      ++damaged;
      EXPECT_TRUE(frame.classes->valid_tiles.none());
      EXPECT_TRUE(std::ranges::all_of(frame.classes->cells, [](auto cell) { return cell == 0; }));
    }
  });
  for (const auto& message : messages) {
    assembler.take(message);
  }
  assembler.finish();
  EXPECT_EQ(damaged, 1U);
  EXPECT_GT(assembler.counts().without_reference, 0U) << "nothing may refer to it";
}

}  // namespace
}  // namespace iog::tools
