// One receiver, several runs: a target that starts over, others that send to the same port, and
// what the network repeats later. The number of the run alone tells them apart (docs/spec.md 3.2),
// and a cell of one run is never shown as one of another.
#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <iterator>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/receive/run_statistics.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr std::uint32_t kFrames = 10;
constexpr std::size_t kContent = protection::kProtectionBytes;
constexpr std::uint32_t kFirst = 0xFFFFFFFF;
constexpr std::uint32_t kSecond = 0;
constexpr std::uint32_t kThird = 0x80000000;

std::uint32_t frame_of(const std::vector<std::byte>& message) {
  return wire::load_be32(std::span(message).subspan(kContent + 8).first<4>());
}

// Of a target whose clock, frame numbers and sequence numbers are ahead by so much.
struct Ahead {
  std::uint32_t us = 0;
  std::uint32_t frames = 0;
  std::uint32_t messages = 0;
};

void add_to(std::span<std::byte, 4> number, std::uint32_t more) {
  wire::store_be32(number, wire::load_be32(number) + more);
}

Messages run(std::uint32_t run_number, std::uint64_t seed, const Ahead& ahead = {}) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  Messages messages = messages_of(car, sample_drive(car, seed, kFrames), run_number);
  protection::Sender sender(stream::kNetworkChannel);
  for (auto& message : messages) {
    const std::span content = std::span(message).subspan(kContent);
    add_to(content.subspan<4, 4>(), ahead.messages);
    add_to(content.subspan<8, 4>(), ahead.frames);
    add_to(content.subspan<16, 4>(), ahead.us);  // the low half of u64
    sender.protect(message);
  }
  return messages;
}

const Messages& first_run() {
  static const Messages messages = run(kFirst, 1);
  return messages;
}
const Messages& second_run() {
  static const Messages messages = run(kSecond, 2);
  return messages;
}
const Messages& third_run() {
  static const Messages messages = run(kThird, 3);
  return messages;
}

Messages of_frames(const Messages& messages, std::uint32_t first, std::uint32_t end) {
  Messages chosen;
  std::ranges::copy_if(messages, std::back_inserter(chosen), [&](const auto& message) {
    return frame_of(message) >= first && frame_of(message) < end;
  });
  return chosen;
}

Messages joined(std::initializer_list<Messages> parts) {
  Messages messages;
  for (const Messages& part : parts) {
    messages.insert(messages.end(), part.begin(), part.end());
  }
  return messages;
}

using Name = std::pair<std::uint32_t, std::uint32_t>;  // of a frame: run and frame number

// Frames as they are when nothing happens to their messages and nothing came before.
std::map<Name, GridFrame> truth_of(const Messages& messages) {
  std::map<Name, GridFrame> frames;
  FrameAssembler assembler([&](GridFrame&& frame) {
    const Name name{frame.header.run_number, frame.header.frame_number};
    frames.emplace(name, std::move(frame));
  });
  for (const auto& message : messages) {
    assembler.take(message);
  }
  assembler.finish();
  return frames;
}

const std::map<Name, GridFrame>& truth() {
  static const auto frames = [] {
    auto all = truth_of(first_run());
    all.merge(truth_of(second_run()));
    all.merge(truth_of(third_run()));
    return all;
  }();
  return frames;
}

struct Shown {
  std::vector<Name> frames;     // as they came
  std::size_t wrong_tiles = 0;  // valid, and not those of their frame
  std::size_t whole = 0;
  MessageCounts counts;

  [[nodiscard]] std::size_t of_run(std::uint32_t run_number) const {
    return static_cast<std::size_t>(std::ranges::count(frames, run_number, &Name::first));
  }
};

Shown show(const Messages& messages, const std::map<Name, GridFrame>& right = truth()) {
  Shown shown;
  FrameAssembler assembler([&](const GridFrame& frame) {
    const Name name{frame.header.run_number, frame.header.frame_number};
    shown.frames.push_back(name);
    shown.whole += frame.is_whole() ? 1U : 0U;
    const GridFrame& expected = right.at(name);
    if (frame.cells == expected.cells) {
      return;
    }
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      const bool is_equal = cells_of_tile(frame.cells, tile) == cells_of_tile(expected.cells, tile);
      shown.wrong_tiles += frame.valid_tiles.test(tile) && !is_equal ? 1U : 0U;
    }
  });
  for (const auto& message : messages) {
    assembler.take(message);
  }
  assembler.finish();
  shown.counts = assembler.counts();
  EXPECT_EQ(shown.counts.datagrams(), messages.size()) << "each has one fate";
  EXPECT_EQ(shown.wrong_tiles, 0U);
  return shown;
}

TEST(RunChange, ANewRunReplacesTheOldOneAndNothingOfItIsLost) {
  const Shown shown = show(joined({first_run(), second_run(), third_run()}));
  EXPECT_EQ(shown.counts.restarts, 2U);
  EXPECT_EQ(shown.whole, 3 * kFrames);
  EXPECT_EQ(shown.counts.messages, first_run().size() + second_run().size() + third_run().size());
}

// Its clock and its other numbers may go on, go back, or be those of the run before.
TEST(RunChange, NoOtherNumberTellsARun) {
  const std::vector<Ahead> aheads{{},
                                  {.us = 1},
                                  {.us = 400'000, .frames = 5},
                                  {.us = 400'000, .frames = 5, .messages = 1000},
                                  {.us = 50'000'000, .frames = 10'000, .messages = 100'000}};
  for (const Ahead& ahead : aheads) {
    const Messages second = run(kSecond, 2, ahead);
    auto right = truth_of(first_run());
    right.merge(truth_of(second));
    const Shown shown = show(joined({of_frames(first_run(), 0, 5), second}), right);
    EXPECT_EQ(shown.counts.restarts, 1U) << ahead.us;
    EXPECT_EQ(shown.whole, 5 + kFrames) << ahead.us;
  }
}

TEST(RunChange, ANewRunIsNoticedThroughDoubledMessages) {
  Messages messages = of_frames(first_run(), 0, 5);
  for (const auto& message : second_run()) {
    messages.insert(messages.end(), 2, message);
  }
  const Shown shown = show(messages);
  EXPECT_EQ(shown.counts.restarts, 1U);
  EXPECT_EQ(shown.whole, 5 + kFrames);
}

TEST(RunChange, ANewRunIsNoticedThroughDisorder) {
  Messages second = second_run();
  for (std::size_t i = 3; i < second.size(); i += 4) {
    std::swap(second[i], second[i - 3]);
  }
  const Shown shown = show(joined({of_frames(first_run(), 0, 5), second}));
  EXPECT_EQ(shown.counts.restarts, 1U);
  EXPECT_EQ(shown.whole, 5 + kFrames);
}

// A link that comes up late: of the new run come only frames that fit behind those of the old one,
// and refer to frames whose numbers the receiver knows.
TEST(RunChange, WhatAFrameRefersToIsNotTakenFromAnotherRun) {
  const Shown shown =
      show(joined({of_frames(first_run(), 0, 5), of_frames(second_run(), 5, kFrames)}));
  EXPECT_EQ(shown.counts.restarts, 1U);
  EXPECT_GE(shown.counts.without_reference, 1U);
  EXPECT_EQ(shown.of_run(kSecond), kFrames - 5);
}

TEST(RunChange, MessagesOfARunThatWasReplacedAreCountedAndNeverShown) {
  const Messages late = of_frames(first_run(), 5, kFrames);  // they have never come before
  const Messages again = of_frames(first_run(), 0, 5);
  const Shown shown = show(joined({again, of_frames(second_run(), 0, 3), late, again,
                                   of_frames(second_run(), 3, kFrames), late, again}));
  EXPECT_EQ(shown.counts.restarts, 1U);
  EXPECT_EQ(shown.of_run(kFirst), 5U);
  EXPECT_EQ(shown.whole, 5 + kFrames) << "and the newest run loses nothing by them";
  EXPECT_EQ(shown.counts.other_run, 2 * (late.size() + again.size()));
}

TEST(RunChange, NoRunThatWasReplacedComesBack) {
  const Shown shown = show(
      joined({first_run(), second_run(), third_run(), second_run(), first_run(), third_run()}));
  EXPECT_EQ(shown.counts.restarts, 2U);
  EXPECT_EQ(shown.frames.size(), 3 * kFrames);
  EXPECT_EQ(shown.counts.other_run, first_run().size() + second_run().size());
}

// A frame that waits for messages is shown as far as it has come before the new run is.
TEST(RunChange, WhatTheOldRunLeftUnfinishedIsShownFirst) {
  Messages messages = of_frames(first_run(), 0, 2);
  messages.pop_back();  // the frame's end
  const Shown shown = show(joined({messages, second_run()}));
  ASSERT_EQ(shown.frames.size(), 2 + kFrames);
  EXPECT_EQ(shown.frames[1], Name(kFirst, 1));
  EXPECT_EQ(shown.frames[2], Name(kSecond, 0));
  EXPECT_EQ(shown.whole, 1 + kFrames);
}

// Two messages, however often they come, are no run; and a third is none if the newest run goes on
// between them.
TEST(RunChange, StrayMessagesEndNoStream) {
  const Messages& stray = second_run();
  const Messages before = of_frames(first_run(), 0, 2);
  const Messages behind = of_frames(first_run(), 2, kFrames);
  const Messages twice{stray[0], stray[1], stray[0], stray[1], stray[1], stray[0]};
  const Shown doubled = show(joined({before, twice, behind}));
  EXPECT_EQ(doubled.counts.restarts, 0U);
  EXPECT_EQ(doubled.whole, kFrames);
  EXPECT_EQ(doubled.counts.other_run, twice.size());

  Messages messages = before;
  for (std::size_t i = 0; i < behind.size(); ++i) {
    messages.push_back(behind[i]);
    if (i + 1 < behind.size()) {  // the last one may be confirmed: nothing contradicts it
      messages.push_back(stray[2 * (i % 10)]);
      messages.push_back(stray[2 * (i % 10) + 1]);
    }
  }
  const Shown scattered = show(messages);
  EXPECT_EQ(scattered.counts.restarts, 0U);
  EXPECT_EQ(scattered.whole, kFrames);
  EXPECT_EQ(scattered.of_run(kSecond), 0U);
}

TEST(RunChange, ThreeMessagesOfANewRunAreOne) {
  const Messages third(second_run().begin(), second_run().begin() + 3);
  const Shown shown = show(joined({of_frames(first_run(), 0, 2), {third[2], third[0], third[1]}}));
  EXPECT_EQ(shown.counts.restarts, 1U);
  EXPECT_EQ(shown.of_run(kSecond), 1U);
  EXPECT_EQ(shown.counts.other_run, 0U);
}

// A loop in the network, or somebody who repeats what he has heard: one frame in one burst.
TEST(RunChange, AFrameThatComesOnceMoreIsNotTheNewest) {
  const Messages again = of_frames(first_run(), 2, 3);
  const Shown shown =
      show(joined({of_frames(first_run(), 0, 8), again, of_frames(first_run(), 8, kFrames)}));
  EXPECT_TRUE(std::ranges::is_sorted(shown.frames)) << "an old frame was shown as the newest";
  EXPECT_EQ(shown.counts.restarts, 0U);
  EXPECT_EQ(shown.counts.too_late, again.size());
  EXPECT_EQ(shown.whole, kFrames);
}

// A target counts since its start, and a table is of all that was received.
TEST(RunChange, WhatEachRunHasDroppedAddsUp) {
  RunStatistics statistics;
  const auto add = [&](std::uint32_t run, std::uint32_t dropped) {
    GridFrame frame;
    frame.header.run_number = run;
    frame.has_end = true;
    frame.end.packet_drops.fill(dropped);
    statistics.add(frame);
  };
  add(kFirst, 3);
  add(kFirst, 7);
  add(kSecond, 0);
  EXPECT_EQ(statistics.packets_late(), 7U);
  add(kSecond, 2);
  add(kThird, 1);
  EXPECT_EQ(statistics.packets_late(), 10U);
}

}  // namespace
}  // namespace iog::tools
