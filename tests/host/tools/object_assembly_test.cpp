// Lists of objects, put together from messages that a network has lost, mixed up and repeated, and
// that somebody has forged: all of a frame's list is shown, as it was sent, or none of it.
#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "gtest/gtest.h"

#include "fake_class_target.hpp"
#include "tools/frames/frame_assembler.hpp"

namespace iog::tools {
namespace {

using Messages = FakeClassTarget::Messages;

constexpr std::uint32_t kFrames = 8;
constexpr std::uint16_t kObjects = 70;  // 32, 32 and 6
constexpr std::size_t kBody = protection::kProtectionBytes + stream::kHeaderBytes;
constexpr std::size_t kObject = kBody + 24;
constexpr std::size_t kObjectBytes = 40;

Messages run(std::uint16_t objects) {
  FakeClassTarget target({.seed = 1}, 7, false);
  target.look_for_objects(objects);
  return target.frames(kFrames);
}

bool is_of_objects(const std::vector<std::byte>& message) {
  return message.at(protection::kProtectionBytes) ==
         static_cast<std::byte>(stream::MessageType::kObjects);
}

bool are_equal(const stream::ObjectList& a, const stream::ObjectList& b) {
  return a.time_us == b.time_us && a.tracks_refused == b.tracks_refused &&
         a.hits_left == b.hits_left && std::ranges::equal(a.all(), b.all());
}

struct Outcome {
  std::size_t frames = 0;
  std::size_t lists = 0;
  MessageCounts counts;
};

// No list is another than that of its frame.
Outcome assemble(const Messages& messages, std::uint16_t objects = kObjects) {
  Outcome outcome;
  FrameAssembler assembler([&](const GridFrame& frame) {
    ++outcome.frames;
    if (frame.objects) {
      ++outcome.lists;
      EXPECT_TRUE(are_equal(*frame.objects,
                            FakeClassTarget::objects_in(frame.header.frame_number, objects)))
          << frame.header.frame_number;
    }
  });
  for (const auto& message : messages) {
    assembler.take(message);
  }
  assembler.finish();
  outcome.counts = assembler.counts();
  EXPECT_EQ(outcome.counts.datagrams(), messages.size()) << "each has one fate";
  return outcome;
}

// The messages with the first frame's parts of objects changed, and all protected once more by a
// sender that means well.
Messages changed(const std::function<void(std::vector<std::byte>*)>& change) {
  Messages messages = run(kObjects);
  change(&*std::ranges::find_if(messages, is_of_objects));
  protection::Sender sender(stream::kNetworkChannel);
  for (auto& message : messages) {
    sender.protect(message);
  }
  return messages;
}

void put(std::vector<std::byte>& message, std::size_t at, int value) {
  message.at(at) = static_cast<std::byte>(value);
}

TEST(ObjectAssembly, EveryFrameHasItsList) {
  for (const std::uint16_t objects : std::vector<std::uint16_t>{0, 1, 32, 33, 256}) {
    const Outcome outcome = assemble(run(objects), objects);
    EXPECT_EQ(outcome.lists, kFrames) << objects;
    EXPECT_EQ(outcome.counts.malformed, 0U);
    EXPECT_EQ(outcome.counts.not_understood, 0U);
  }
}

TEST(ObjectAssembly, ATargetThatLooksForNoneHasNone) {
  const Outcome outcome = assemble(FakeClassTarget({.seed = 1}, 7, false).frames(kFrames));
  EXPECT_EQ(outcome.frames, kFrames);
  EXPECT_EQ(outcome.lists, 0U);
}

TEST(ObjectAssembly, AFrameWaitsForItsObjects) {
  FakeClassTarget target({.seed = 1}, 7, false);
  target.look_for_objects(kObjects);
  const Messages frame = target.next();
  for (std::size_t last = 0; last < frame.size(); ++last) {
    std::size_t lists = 0;
    FrameAssembler assembler([&](const GridFrame& shown) { lists += shown.objects ? 1U : 0U; });
    for (std::size_t i = 0; i < frame.size(); ++i) {
      if (i != last) {
        assembler.take(frame[i]);
      }
    }
    EXPECT_EQ(lists, 0U) << last;
    assembler.take(frame[last]);
    EXPECT_EQ(lists, 1U) << last;
  }
}

TEST(ObjectAssembly, OfALostPartNothingIsShown) {
  const Messages sent = run(kObjects);
  for (std::size_t lost = 0; lost < sent.size(); ++lost) {
    if (is_of_objects(sent[lost])) {
      Messages messages = sent;
      messages.erase(messages.begin() + static_cast<std::ptrdiff_t>(lost));
      const Outcome outcome = assemble(messages);
      EXPECT_EQ(outcome.frames, kFrames);
      EXPECT_EQ(outcome.lists, kFrames - 1);
    }
  }
}

TEST(ObjectAssembly, OrderAndRepetitionChangeNothing) {
  Messages messages;
  for (const auto& message : run(kObjects)) {
    messages.insert(messages.end(), 2, message);
  }
  tests::Random random(99);
  for (std::size_t i = 1; i < messages.size(); ++i) {
    std::swap(messages[i], messages[i - random.below(std::min<std::size_t>(i, 16))]);
  }
  EXPECT_EQ(assemble(messages).lists, kFrames);
}

// Each of these is a message that is sound by itself.
TEST(ObjectAssembly, PartsThatContradictEachOtherAreNoList) {
  const std::vector<std::function<void(std::vector<std::byte>*)>> forgeries{
      [](auto* parts) { put(parts[1], kBody + 15, 0); },                         // another time
      [](auto* parts) { put(parts[1], kBody + 17, 9); },                         // another count
      [](auto* parts) { put(parts[1], kBody + 5, 71); },                         // one object more
      [](auto* parts) { put(parts[2], kBody + 6, 1); },                          // the second twice
      [](auto* parts) { std::swap(parts[0][kBody + 6], parts[1][kBody + 6]); },  // in wrong order
      [](auto* parts) { put(parts[2], kObject + 3, 64); },  // an id of the part before
      [](auto* parts) {                                     // the last is shorter than was said
        parts[2].resize(parts[2].size() - kObjectBytes);
      },
      [](auto* parts) {  // the first has only one object, and the last so many more
        parts[0].resize(kObject + kObjectBytes);
      },
  };
  for (std::size_t i = 0; i < forgeries.size(); ++i) {
    const Outcome outcome = assemble(changed(forgeries[i]));
    EXPECT_EQ(outcome.frames, kFrames) << i;
    EXPECT_EQ(outcome.lists, kFrames - 1) << i;
    EXPECT_GE(outcome.counts.malformed, 1U) << i;
  }
}

TEST(ObjectAssembly, AForgedPartIsNotShown) {
  const std::vector<std::function<void(std::vector<std::byte>&)>> forgeries{
      [](auto& part) { put(part, kBody + 1, 20); },   // a shorter header
      [](auto& part) { put(part, kBody + 3, 48); },   // longer objects
      [](auto& part) { put(part, kBody + 7, 200); },  // parts
      [](auto& part) { put(part, kObject + 4, 9); },  // a state
      [](auto& part) { put(part, kObject + 4, 1); },  // the speed of something young
      [](auto& part) { part.pop_back(); },            // a byte is missing
      [](auto& part) { put(part, kObject + 3, 0); },  // no id
      [](auto& part) { std::fill_n(part.begin() + kBody + 8, 8, std::byte{0}); },  // no time
  };
  for (std::size_t i = 0; i < forgeries.size(); ++i) {
    const Outcome outcome = assemble(changed([&](auto* parts) { forgeries[i](parts[0]); }));
    EXPECT_EQ(outcome.lists, kFrames - 1) << i;
    EXPECT_EQ(outcome.counts.malformed, 1U) << i;
  }
}

TEST(ObjectAssembly, ObjectsThatTheFrameHasNotAreNotBelieved) {
  Messages messages = run(kObjects);
  for (auto& message : messages) {
    message.at(protection::kProtectionBytes + 1) &= ~std::byte{stream::kFlagObjects};
  }
  protection::Sender sender(stream::kNetworkChannel);
  for (auto& message : messages) {
    sender.protect(message);
  }
  const Outcome outcome = assemble(messages);
  EXPECT_EQ(outcome.frames, kFrames);
  EXPECT_EQ(outcome.lists, 0U);
  EXPECT_EQ(outcome.counts.malformed, 3 * kFrames);
}

}  // namespace
}  // namespace iog::tools
