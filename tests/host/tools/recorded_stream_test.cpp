// A stream in a file, recorded once more: where it is silent, and where it ends.
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/record/sources.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kFirstUs = 1'000'000;
constexpr std::uint32_t kFrames = 4;

struct Seen {
  std::size_t datagrams = 0;
  std::vector<std::uint32_t> frames;
  std::vector<std::size_t> unknown_tiles;  // after each, of which nothing is known
};

class SeeingRecording : public Recording {
 public:
  explicit SeeingRecording(Seen& seen) : seen_(&seen) {}

  void take_datagram(const CapturedDatagram& /*datagram*/) override { ++seen_->datagrams; }
  void take_frame(const RecordedFrame& recorded) override {
    seen_->frames.push_back(recorded.frame->header.frame_number);
    std::size_t unknown = 0;
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      unknown += recorded.live->age_of(tile) ? 0U : 1U;
    }
    seen_->unknown_tiles.push_back(unknown);
  }
  void finish(const Facts& /*facts*/) override {}

 private:
  Seen* seen_;
};

const Messages& whole_stream() {
  static const Messages messages = [] {
    const CatalogueEntry& car = find_vehicle("reference_car");
    return messages_of(car, sample_drive(car, 1, kFrames));
  }();
  return messages;
}

// Of a file with all but one message of the stream, and a gap before the place of that or another
// one.
Seen seen_of(std::size_t left_out, std::size_t gap_at, std::uint64_t gap_us) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "stream.pcap";
  PcapWriter writer(path);
  std::uint64_t time_us = kFirstUs;
  for (std::size_t i = 0; i < whole_stream().size(); ++i) {
    time_us += i == gap_at ? gap_us : 100;
    if (i != left_out) {
      writer.write({.time_us = time_us,
                    .source = kStreamSource,
                    .destination = kStreamDestination,
                    .payload = whole_stream()[i]});
    }
  }
  writer.finish();
  Seen seen;
  Recorder::Recordings recordings;
  recordings.push_back(std::make_unique<SeeingRecording>(seen));
  Recorder recorder(std::move(recordings));
  record_stream(path, recorder);
  recorder.finish();
  return seen;
}

// The first message of frame 2, which has tiles.
std::size_t first_of_frame_2() {
  std::size_t ends = 0;
  std::size_t i = 0;
  for (; ends < 2; ++i) {
    const std::byte type = whole_stream()[i].at(protection::kProtectionBytes);
    ends += type == static_cast<std::byte>(stream::MessageType::kFrameEnd) ? 1U : 0U;
  }
  return i;
}

// As of a live stream (FrameAssembler::kLongestSilence): how old they are is not known.
TEST(RecordedStream, AfterASilenceNothingIsKnownOfOlderTiles) {
  const Seen without = seen_of(first_of_frame_2(), first_of_frame_2(), 499'900);
  const Seen with = seen_of(first_of_frame_2(), first_of_frame_2(), 499'901);
  ASSERT_EQ(without.frames.size(), kFrames);
  EXPECT_EQ(without.unknown_tiles.at(2), 0U);
  EXPECT_GT(with.unknown_tiles.at(2), 0U);
  EXPECT_EQ(with.datagrams, without.datagrams);
}

// Who has recorded it was busy for a while, and the network has kept all for him.
TEST(RecordedStream, NoFrameEndsInAGap) {
  const std::size_t none = whole_stream().size();
  const Seen seen = seen_of(none, first_of_frame_2() + 2, 3'000'000);
  EXPECT_EQ(seen.frames, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(seen.unknown_tiles, (std::vector<std::size_t>{0, 0, 0, 0}));
}

TEST(RecordedStream, OneThatWasStoppedInMidFrameEndsAtTheLastWholeOne) {
  const Seen seen = seen_of(whole_stream().size() - 1, 0, 0);
  EXPECT_EQ(seen.datagrams, whole_stream().size() - 1);
  EXPECT_EQ(seen.frames, (std::vector<std::uint32_t>{0, 1, 2}));
}

}  // namespace
}  // namespace iog::tools
