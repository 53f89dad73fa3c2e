// One receiver, several runs: a target that starts over, others that send to the same port, and
// what the network repeats later. A cell of one run must never be shown as one of another.
#include <algorithm>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "tools/receive/frame_assembler.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr std::uint32_t kFrames = 10;
constexpr std::uint32_t kSecondUs = 1234;
constexpr std::size_t kContent = protection::kProtectionBytes;

std::uint32_t u32_at(const std::vector<std::byte>& message, std::size_t offset) {
  return wire::load_be32(std::span(message).subspan(kContent + offset).first<4>());
}
std::uint32_t sequence_of(const std::vector<std::byte>& message) { return u32_at(message, 4); }
std::uint32_t frame_of(const std::vector<std::byte>& message) { return u32_at(message, 8); }

// Of a target whose clock, frame numbers and sequence numbers are ahead by so much.
struct Ahead {
  std::uint32_t us = 0;
  std::uint32_t frames = 0;
  std::uint32_t messages = 0;
};

Messages run(std::uint64_t seed, const Ahead& ahead) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  Messages messages = messages_of(car, sample_drive(car, seed, kFrames));
  protection::Sender sender(stream::kNetworkChannel);
  for (auto& message : messages) {
    const auto add = [&](std::size_t offset, std::uint32_t more) {
      const auto number = std::span(message).subspan(kContent + offset).first<4>();
      wire::store_be32(number, wire::load_be32(number) + more);
    };
    add(4, ahead.messages);
    add(8, ahead.frames);
    add(16, ahead.us);  // the low half of u64
    sender.protect(message);
  }
  return messages;
}

const Messages& first_run() {
  static const Messages messages = run(1, {});
  return messages;
}
const Messages& second_run() {
  static const Messages messages = run(2, {.us = kSecondUs});
  return messages;
}

Messages of_frames(const Messages& messages, std::uint32_t first, std::uint32_t end) {
  Messages chosen;
  std::ranges::copy_if(messages, std::back_inserter(chosen), [&](const auto& message) {
    return frame_of(message) >= first && frame_of(message) < end;
  });
  return chosen;
}

Messages joined(Messages messages, const Messages& more) {
  messages.insert(messages.end(), more.begin(), more.end());
  return messages;
}

// Frames as they are when nothing happens to their messages, by the time at which they closed.
std::map<std::uint64_t, GridFrame> truth_of(const Messages& messages) {
  std::map<std::uint64_t, GridFrame> frames;
  FrameAssembler assembler([&](GridFrame&& frame) {
    const std::uint64_t closed_us = frame.header.closed_us;
    frames.emplace(closed_us, std::move(frame));
  });
  for (const auto& message : messages) {
    assembler.take(message);
  }
  assembler.finish();
  return frames;
}

struct Shown {
  std::vector<std::uint64_t> closed_us;  // of the frames, as they came
  std::size_t wrong_tiles = 0;           // valid, and not those of their frame
  std::size_t whole = 0;
  MessageCounts counts;
};

Shown show(const Messages& messages) {
  auto truth = truth_of(first_run());
  truth.merge(truth_of(second_run()));
  Shown shown;
  FrameAssembler assembler([&](const GridFrame& frame) {
    shown.closed_us.push_back(frame.header.closed_us);
    shown.whole += frame.is_whole() ? 1U : 0U;
    const auto known = truth.find(frame.header.closed_us);
    for (std::size_t tile = 0; tile < geometry::kTileCount && known != truth.end(); ++tile) {
      bool is_equal = true;
      for (std::size_t i = 0; i < tile_coding::kTileBytes; ++i) {
        const std::size_t cell = cell_of_tile(tile, i);
        is_equal = is_equal && frame.cells[cell] == known->second.cells[cell];
      }
      shown.wrong_tiles += frame.valid_tiles.test(tile) && !is_equal ? 1U : 0U;
    }
  });
  for (const auto& message : messages) {
    assembler.take(message);
  }
  assembler.finish();
  shown.counts = assembler.counts();
  EXPECT_EQ(shown.counts.datagrams(), messages.size()) << "each has one fate";
  return shown;
}

TEST(RunChange, ANewRunIsNoticedThroughDoubledMessages) {
  Messages messages = of_frames(first_run(), 0, 5);
  for (const auto& message : second_run()) {
    messages.insert(messages.end(), 2, message);
  }
  const Shown shown = show(messages);
  EXPECT_EQ(shown.wrong_tiles, 0U);
  EXPECT_EQ(shown.counts.restarts, 1U);
  EXPECT_EQ(shown.whole, 5 + kFrames);
}

TEST(RunChange, ANewRunIsNoticedThroughDisorder) {
  Messages second = second_run();
  for (std::size_t i = 3; i < second.size(); i += 4) {
    std::swap(second[i], second[i - 3]);
  }
  const Shown shown = show(joined(of_frames(first_run(), 0, 5), second));
  EXPECT_EQ(shown.wrong_tiles, 0U);
  EXPECT_EQ(shown.counts.restarts, 1U);
  EXPECT_EQ(shown.whole, 5 + kFrames);
}

// A link that comes up late: of the new run come only frames that fit behind those of the old one,
// and refer to frames whose numbers the receiver knows.
TEST(RunChange, WhatAFrameOfAnotherRunRefersToIsNotTakenFromThisOne) {
  for (const std::uint32_t messages : {0U, 1000U}) {
    const Messages second = run(2, {.us = kSecondUs, .messages = messages});
    const Shown shown = show(joined(of_frames(first_run(), 0, 5), of_frames(second, 5, kFrames)));
    EXPECT_EQ(shown.wrong_tiles, 0U) << messages;
    EXPECT_GE(shown.counts.without_reference, 1U) << messages;
  }
}

// Some messages of the frames before have come: too few to be a new run, and enough to know that
// what is kept is not of theirs. None of the frames behind has to be whole for that.
TEST(RunChange, AMessageOfAnotherRunMakesWhatIsKeptDoubtful) {
  Messages messages = of_frames(first_run(), 0, 5);
  messages.push_back(of_frames(second_run(), 4, 5).front());
  for (const auto& message : of_frames(second_run(), 5, kFrames)) {
    if (sequence_of(message) % 7 != 0) {
      messages.push_back(message);
    }
  }
  EXPECT_EQ(show(messages).wrong_tiles, 0U);
}

// A loop in the network, or somebody who repeats what he has heard: one frame in one burst.
TEST(RunChange, AFrameThatComesOnceMoreIsNotTheNewest) {
  Messages messages = of_frames(first_run(), 0, 8);
  messages = joined(messages, of_frames(first_run(), 2, 3));
  messages = joined(messages, of_frames(first_run(), 8, kFrames));
  ASSERT_GE(of_frames(first_run(), 2, 3).size(), 16U);
  const Shown shown = show(messages);
  EXPECT_TRUE(std::ranges::is_sorted(shown.closed_us)) << "an old frame was shown as the newest";
  EXPECT_EQ(shown.counts.restarts, 0U);
  EXPECT_EQ(shown.whole, kFrames);
}

// One message of a target that has run for longer makes all numbers of this one old ones.
TEST(RunChange, AMessageOfAnOlderTargetDoesNotEndTheStream) {
  const Messages older = run(3, {.us = 50'000'000, .frames = 10'000, .messages = 100'000});
  Messages messages = of_frames(first_run(), 0, 2);
  messages.push_back(older.front());
  messages = joined(messages, of_frames(first_run(), 2, kFrames));
  const Shown shown = show(messages);
  EXPECT_EQ(shown.wrong_tiles, 0U);
  EXPECT_EQ(shown.counts.restarts, 1U);
  EXPECT_EQ(shown.closed_us.size(), kFrames + 1) << "and that of the stranger";
  EXPECT_EQ(shown.whole, 2U + 1U) << "those before, and the eighth behind";
  EXPECT_EQ(shown.counts.repeated, 0U);
}

}  // namespace
}  // namespace iog::tools
