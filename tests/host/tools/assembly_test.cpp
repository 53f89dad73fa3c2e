#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/frames/sequence_watch.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/hexadecimal.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/simulate/random.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kFrames = 4;

const Messages& sample() {
  static const Messages messages = [] {
    const CatalogueEntry& car = find_vehicle("reference_car");
    return messages_of(car, sample_drive(car, 1, kFrames));
  }();
  return messages;
}

struct Outcome {
  std::vector<FrameRecord> records;
  std::vector<bool> whole;
  MessageCounts counts;
  std::uint64_t lost = 0;
  protection::ChannelState channel = protection::ChannelState::kNoData;
};

Outcome assemble(const Messages& messages) {
  Outcome outcome;
  FrameAssembler assembler([&](const GridFrame& frame) {
    outcome.records.push_back(record_of(frame));
    outcome.whole.push_back(frame.is_whole() && grid_crc_of(frame) == frame.end.grid_crc);
  });
  for (const auto& message : messages) {
    assembler.take(message);
  }
  assembler.finish();
  outcome.counts = assembler.counts();
  outcome.lost = assembler.messages_lost();
  outcome.channel = assembler.channel();
  return outcome;
}

std::vector<FrameRecord> undisturbed() { return assemble(sample()).records; }

// The message of tiles in which tile `number` of the sample's first frame would be missing.
Messages without(std::size_t number) {
  Messages messages = sample();
  messages.erase(messages.begin() + static_cast<std::ptrdiff_t>(number));
  return messages;
}

// Of the first frame: all but its end.
std::size_t first_frame_end() {
  const auto is_end = [](const std::vector<std::byte>& message) {
    return message.at(protection::kProtectionBytes) ==
           static_cast<std::byte>(stream::MessageType::kFrameEnd);
  };
  return static_cast<std::size_t>(std::ranges::find_if(sample(), is_end) - sample().begin());
}

TEST(FrameAssembler, PutsFramesTogether) {
  const Outcome outcome = assemble(sample());
  ASSERT_EQ(outcome.records.size(), kFrames);
  EXPECT_EQ(std::ranges::count(outcome.whole, true), kFrames);
  EXPECT_EQ(outcome.counts.messages, sample().size());
  EXPECT_EQ(outcome.lost, 0U);
  EXPECT_EQ(outcome.counts.late + outcome.counts.repeated + outcome.counts.malformed +
                outcome.counts.too_late + outcome.counts.without_reference,
            0U);
  EXPECT_EQ(outcome.channel, protection::ChannelState::kValid);
}

TEST(FrameAssembler, ALostMessageIsMissedInItsFrameAndWhereOthersReferToIt) {
  const Outcome outcome = assemble(without(5));
  ASSERT_EQ(outcome.records.size(), kFrames);
  EXPECT_EQ(outcome.lost, 1U);
  EXPECT_FALSE(outcome.whole[0]);
  EXPECT_LT(outcome.records[0].tiles, undisturbed()[0].tiles);
  EXPECT_EQ(first_difference(outcome.records, undisturbed())->find("frame 0: same packets"), 0U);
  EXPECT_GT(outcome.counts.without_reference, 0U);
}

TEST(FrameAssembler, ALostFrameEndStillLeavesItsTiles) {
  const Outcome outcome = assemble(without(first_frame_end()));
  ASSERT_EQ(outcome.records.size(), kFrames);
  EXPECT_FALSE(outcome.whole[0]);
  EXPECT_FALSE(first_difference(outcome.records, undisturbed()).has_value());
}

// Cells of another size and another number of them do not appear for one frame.
TEST(FrameAssembler, AFrameWithoutAnyTilesHasTheGridOfTheOneBefore) {
  const CatalogueEntry& car = find_vehicle("robot_2d");
  ASSERT_NE(car.vehicle->grid, geometry::Grid{});
  Messages messages = messages_of(car, sample_drive(car, 1, kFrames));
  const std::size_t all = messages.size();
  std::erase_if(messages, [](const std::vector<std::byte>& message) {
    stream::Header header;
    std::span<const std::byte> body;
    return stream::read_header(std::span(message).subspan(protection::kProtectionBytes), header,
                               body) == stream::ReadStatus::kOk &&
           header.frame_number == 2 && header.type == stream::MessageType::kTiles;
  });
  ASSERT_LT(messages.size(), all);
  std::size_t frames = 0;
  FrameAssembler assembler([&](const GridFrame& frame) {
    EXPECT_EQ(frame.shape, car.vehicle->grid) << frames;
    EXPECT_EQ(frame.epsilon_e5, car.vehicle->epsilon_e5) << frames;
    ++frames;
  });
  std::ranges::for_each(messages, [&](const auto& message) { assembler.take(message); });
  assembler.finish();
  EXPECT_GE(frames, kFrames - 1);
}

TEST(FrameAssembler, RepeatedMessagesChangeNothing) {
  Messages messages;
  for (const auto& message : sample()) {
    messages.insert(messages.end(), 2, message);
  }
  const Outcome outcome = assemble(messages);
  EXPECT_FALSE(first_difference(outcome.records, undisturbed()).has_value());
  // The second end of a frame comes when the frame is over.
  EXPECT_EQ(outcome.counts.repeated + outcome.counts.too_late, sample().size());
  EXPECT_EQ(outcome.counts.too_late, kFrames);
}

TEST(FrameAssembler, OrderWithinReachChangesNothing) {
  Messages messages = sample();
  Random random(99);
  for (std::size_t i = 1; i < messages.size(); ++i) {
    std::swap(messages[i], messages[i - random.below(std::min<std::size_t>(i, 8))]);
  }
  const Outcome outcome = assemble(messages);
  EXPECT_FALSE(first_difference(outcome.records, undisturbed()).has_value());
  EXPECT_EQ(outcome.lost, 0U);
  EXPECT_GT(outcome.counts.late, sample().size() / 4);
}

TEST(FrameAssembler, GarbageIsCountedAndChangesNothing) {
  Messages messages;
  Random random(5);
  std::uint64_t garbage = 0;
  for (const auto& message : sample()) {
    messages.push_back(message);
    std::vector<std::byte> cut(message.begin(), message.begin() + 40);
    std::vector<std::byte> other_version = message;
    other_version[13] = std::byte{1};
    std::vector<std::byte> flipped = message;
    flipped[protection::kProtectionBytes + random.below(60)] ^= std::byte{0x10};
    std::vector<std::byte> noise(random.below(1400));
    for (std::byte& byte : noise) {
      byte = static_cast<std::byte>(random.next());
    }
    messages.insert(messages.end(), {cut, other_version, flipped, noise});
    garbage += 4;
  }
  const Outcome outcome = assemble(messages);
  EXPECT_FALSE(first_difference(outcome.records, undisturbed()).has_value());
  EXPECT_EQ(outcome.counts.other_version, sample().size());
  EXPECT_EQ(outcome.counts.corrupt + outcome.counts.not_ours + outcome.counts.other_version,
            garbage);
  EXPECT_EQ(outcome.counts.datagrams(), messages.size()) << "each has one fate";
  EXPECT_EQ(outcome.channel, protection::ChannelState::kInvalid);
}

// Messages of a sender that protects well and writes nonsense.
class Liar {
 public:
  [[nodiscard]] std::vector<std::byte> protect(std::vector<std::byte> message) {
    sender_.protect(message);
    return message;
  }

 private:
  protection::Sender sender_{stream::kNetworkChannel};
};

TEST(FrameAssembler, AMessageThatContradictsItselfIsNotBelieved) {
  Messages messages = sample();
  Liar liar;
  constexpr std::size_t kBody = protection::kProtectionBytes + stream::kHeaderBytes;
  messages[3][kBody] = std::byte{0xFF};  // speaks of no tile of the grid
  messages[4][kBody + stream::kTilesHeaderBytes + 2] = std::byte{9};  // an encoding of the future
  messages[5][kBody + 10] ^= std::byte{1};                            // another size of cells
  for (auto& message : messages) {
    message = liar.protect(message);
  }
  const Outcome outcome = assemble(messages);
  EXPECT_EQ(outcome.counts.malformed, 1U);
  EXPECT_EQ(outcome.counts.tiles_not_understood, 1U);
  EXPECT_EQ(outcome.counts.not_understood, 1U);
  EXPECT_EQ(outcome.counts.datagrams(), sample().size()) << "each has one fate";
  EXPECT_EQ(outcome.counts.corrupt, 0U);
  EXPECT_FALSE(outcome.whole[0]);
}

// One old message, or some, are no new run.
TEST(FrameAssembler, OldMessagesAreDropped) {
  Messages messages = sample();
  messages.insert(messages.end(), sample().begin(), sample().begin() + 10);
  const Outcome outcome = assemble(messages);
  EXPECT_EQ(outcome.counts.restarts, 0U);
  EXPECT_EQ(outcome.counts.too_late, 10U);
  EXPECT_EQ(outcome.counts.datagrams(), messages.size());
  EXPECT_FALSE(first_difference(outcome.records, undisturbed()).has_value());
}

TEST(FrameAssembler, ASilenceEndsTheFramesThatWait) {
  std::size_t frames = 0;
  FrameAssembler assembler([&](GridFrame&&) { ++frames; });
  for (std::size_t i = 0; i <= first_frame_end() + 1; ++i) {
    assembler.take(sample()[i]);
  }
  EXPECT_EQ(frames, 1U);
  assembler.note_silence();
  EXPECT_EQ(frames, 2U);
}

// Tiles may refer to what was before it: the run is the same.
TEST(FrameAssembler, ASilenceBetweenTwoFramesChangesNothing) {
  std::size_t whole = 0;
  FrameAssembler assembler([&](const GridFrame& frame) { whole += frame.is_whole() ? 1U : 0U; });
  for (std::size_t i = 0; i < sample().size(); ++i) {
    assembler.take(sample()[i]);
    if (i == first_frame_end()) {
      assembler.note_silence();
    }
  }
  EXPECT_EQ(whole, kFrames);
  EXPECT_EQ(assembler.counts().restarts + assembler.counts().without_reference, 0U);
}

// The numbers of a recording are those that it had: only whoever plays it knows that it begins.
TEST(FrameAssembler, ARecordingThatIsPlayedAgainIsNewIfItsPlayerSaysSo) {
  for (const bool says_so : {false, true}) {
    std::size_t whole = 0;
    FrameAssembler assembler([&](const GridFrame& frame) { whole += frame.is_whole() ? 1U : 0U; });
    for (int round = 0; round < 3; ++round) {
      for (const auto& message : sample()) {
        assembler.take(message);
      }
      if (says_so) {
        assembler.forget();
      }
    }
    EXPECT_EQ(whole, says_so ? 3 * kFrames : kFrames);
    EXPECT_EQ(assembler.counts().too_late, says_so ? 0U : 2 * sample().size());
    EXPECT_EQ(assembler.counts().restarts, 0U);
    EXPECT_EQ(assembler.messages_lost(), 0U);
  }
}

TEST(FrameAssembler, AnotherVersionIsRefusedByName) {
  FrameAssembler assembler([](GridFrame&&) { FAIL(); });
  EXPECT_FALSE(assembler.version_sent().has_value());
  for (std::vector<std::byte> message : sample()) {
    message[13] = std::byte{3};
    assembler.take(message);
  }
  EXPECT_EQ(assembler.version_sent(), 3);
  EXPECT_EQ(words_of_version(3), "interface version 3; this iog reads 5");
  EXPECT_EQ(assembler.counts().other_version, sample().size());
}

TEST(SequenceWatch, CountsGapsAndForgivesTheLate) {
  SequenceWatch watch;
  using Arrival = SequenceWatch::Arrival;
  EXPECT_EQ(watch.arrive(0xFFFFFFFE), Arrival::kInOrder);
  EXPECT_EQ(watch.arrive(1), Arrival::kInOrder);  // 0xFFFFFFFF and 0 are missing
  EXPECT_EQ(watch.lost(), 2U);
  EXPECT_EQ(watch.arrive(0), Arrival::kLate);
  EXPECT_EQ(watch.arrive(0), Arrival::kRepeated);
  EXPECT_EQ(watch.arrive(1), Arrival::kRepeated);
  EXPECT_EQ(watch.lost(), 1U);
}

// The first message that comes need not be the first that was sent.
TEST(SequenceWatch, TheStreamBeginsShortlyBeforeWhatComesFirst) {
  SequenceWatch watch;
  using Arrival = SequenceWatch::Arrival;
  EXPECT_EQ(watch.arrive(5000), Arrival::kInOrder);
  EXPECT_EQ(watch.arrive(4998), Arrival::kLate);
  EXPECT_EQ(watch.arrive(4998), Arrival::kRepeated);
  EXPECT_EQ(watch.lost(), 0U) << "nothing was expected";
  EXPECT_EQ(watch.arrive(5002), Arrival::kInOrder);
  EXPECT_EQ(watch.lost(), 1U);
  EXPECT_EQ(watch.arrive(5001), Arrival::kLate);
  EXPECT_EQ(watch.arrive(4999), Arrival::kLate);
  EXPECT_EQ(watch.lost(), 0U);
  EXPECT_EQ(watch.arrive(100), Arrival::kRepeated) << "too long ago";
}

TEST(FrameRecord, LinesAreReadBack) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "hashes";
  write_records(path, undisturbed());
  EXPECT_FALSE(first_difference(read_records(path), undisturbed()).has_value());
  EXPECT_EQ(line_of({.number = 17,
                     .complete_sensors = 0xF,
                     .partial_sensors = 0,
                     .packets = {6, 6, 12, 600},
                     .points_used = 2871,
                     .tiles = 433,
                     .grid_crc = 0x9AC01B,
                     .is_timed_out = false}),
            "17 f 0 6,6,12,600 2871 433 009ac01b");
  EXPECT_THROW(static_cast<void>(read_records(path + "_missing")), UsageError);
  for (const char* packets : {"6,", ",6", "6,,6", "6;6", "6,70000", "1,2,3,4,5,6,7,8,9", "f"}) {
    OutputFile file(path);
    file.write("0 f 0 " + std::string(packets) + " 2871 433 009ac01b\n");
    file.finish();
    EXPECT_THROW(static_cast<void>(read_records(path)), UsageError) << packets;
  }
}

TEST(FrameRecord, ADifferenceSaysWhetherItIsParticipation) {
  auto received = undisturbed();
  received[2].complete_sensors = 0x7;
  received[2].partial_sensors = 0x8;
  received[2].is_timed_out = true;
  const std::string text = first_difference(received, undisturbed()).value();
  EXPECT_EQ(text.find("frame 2: closed by time on the target; was the host stalled?"), 0U);
  received[3].is_too_slow = true;
  EXPECT_EQ(first_difference(received, undisturbed())
                .value()
                .find("frame 2: the target is too slow for its sensors; received"),
            0U);
  received = undisturbed();
  --received[1].packets[3];
  received[1].grid_crc = 0;
  EXPECT_EQ(
      first_difference(received, undisturbed()).value().find("frame 1: other packets took part"),
      0U)
      << "a packet none of whose points is used";
  received.resize(2);
  received[1] = undisturbed()[1];
  EXPECT_EQ(first_difference(received, undisturbed()).value(),
            "2 frames with evidence received, 4 expected; the common ones are equal");
}

// Any tool can compute it: zlib's crc32 over the CRCs, each four bytes big endian.
TEST(RunHash, IsTheCrcOfTheGridCrcs) {
  RunHash hash;
  hash.add(0x31323334);
  hash.add(0x35363738);
  EXPECT_EQ(hex(hash.value()), "9ae0daaf");  // CRC-32 of "12345678"
}

}  // namespace
}  // namespace iog::tools
