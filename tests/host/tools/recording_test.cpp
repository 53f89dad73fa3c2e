#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "fake_class_target.hpp"
#include "fakes/temporary_folder.hpp"
#include "tools/formats/mcap/reader.hpp"
#include "tools/formats/ros/class_messages.hpp"
#include "tools/formats/ros/grid_messages.hpp"
#include "tools/record/mcap_recording.hpp"
#include "tools/record/recorder.hpp"
#include "tools/vehicles/vehicle_catalogue.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

// What a recording has been given.
struct Given {
  std::vector<std::vector<std::byte>> datagrams;
  std::vector<std::uint32_t> grid_crcs;
  std::vector<std::size_t> stale_tiles;
  std::vector<std::size_t> unknown_tiles;  // that have never arrived
  int finished = 0;
};

class KeepingRecording : public Recording {
 public:
  explicit KeepingRecording(Given& given) : given_(&given) {}

  void take_datagram(const CapturedDatagram& datagram) override {
    given_->datagrams.push_back(datagram.payload);
  }
  void take_frame(const RecordedFrame& recorded) override {
    given_->grid_crcs.push_back(grid_crc_of(*recorded.frame));
    given_->stale_tiles.push_back(recorded.live->stale_tiles());
    std::size_t unknown = 0;
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      unknown += recorded.live->age_of(tile) ? 0U : 1U;
    }
    given_->unknown_tiles.push_back(unknown);
  }
  void finish(const Facts& /*facts*/) override { ++given_->finished; }

 private:
  Given* given_;
};

Recorder::Recordings keeping(Given& given) {
  Recorder::Recordings recordings;
  recordings.push_back(std::make_unique<KeepingRecording>(given));
  return recordings;
}

CapturedDatagram datagram_of(const std::vector<std::byte>& message) {
  return {.time_us = 1, .source = {}, .destination = {}, .payload = message};
}

Messages sample_stream() {
  const CatalogueEntry& car = find_vehicle("reference_car");
  return messages_of(car, sample_drive(car, 1, 6));
}

TEST(Recorder, EveryDatagramAndEveryFrameIsRecorded) {
  const Messages messages = sample_stream();
  Given given;
  Recorder recorder(keeping(given));
  for (const auto& message : messages) {
    recorder.take(datagram_of(message));
  }
  recorder.finish();
  EXPECT_EQ(given.datagrams, messages);
  EXPECT_EQ(given.finished, 1);
  ASSERT_EQ(given.grid_crcs.size(), 6U);
  const auto& records = recorder.census().statistics().records();
  for (std::size_t frame = 0; frame < records.size(); ++frame) {
    EXPECT_EQ(given.grid_crcs[frame], records[frame].grid_crc);
    EXPECT_EQ(given.stale_tiles[frame], 0U);
  }
}

TEST(Recorder, WhatIsNoMessageIsRecordedToo) {
  Given given;
  Recorder recorder(keeping(given));
  recorder.take(datagram_of({}));
  recorder.take(datagram_of(std::vector<std::byte>(1472)));
  recorder.take(datagram_of(std::vector<std::byte>(1473)));  // longer than a datagram on Ethernet
  recorder.finish();
  EXPECT_EQ(given.datagrams.size(), 2U);
  EXPECT_EQ(recorder.too_long(), 1U);
  EXPECT_TRUE(given.grid_crcs.empty());
}

std::uint32_t frame_of(const std::vector<std::byte>& message) {
  stream::Header header;
  std::span<const std::byte> body;
  EXPECT_EQ(
      stream::read_header(std::span(message).subspan(protection::kProtectionBytes), header, body),
      stream::ReadStatus::kOk);
  return header.frame_number;
}

// Frames 0 to 3, perhaps a silence, and frame 4 without its first message.
std::size_t unknown_tiles_after(bool is_silent) {
  Given given;
  Recorder recorder(keeping(given));
  bool has_begun = false;
  for (const auto& message : sample_stream()) {
    const bool is_first = frame_of(message) == 4 && !has_begun;
    has_begun = has_begun || is_first;
    if (is_first && is_silent) {
      recorder.note_silence(2);
    }
    if (!is_first && frame_of(message) < 5) {
      recorder.take(datagram_of(message));
    }
  }
  recorder.finish();
  return given.unknown_tiles.back();
}

TEST(Recorder, AfterASilenceOldTilesAreNotPassedOffAsKnown) {
  EXPECT_EQ(unknown_tiles_after(false), 0U) << "those that are missing are older";
  EXPECT_GT(unknown_tiles_after(true), 0U);
}

// The numbers of ten frames of docs/spec.md 3.9 and 3.10, as FakeClassTarget makes them up.
TEST(StreamCensus, SumsUpClasses) {
  FakeClassTarget target({.seed = 1}, 7);
  StreamCensus census;
  for (const auto& message : target.frames(10)) {
    census.take(message);
  }
  census.finish();
  std::map<std::string, std::string> facts;
  for (const auto& [name, value] : census.facts()) {
    facts[name] = value;
  }
  EXPECT_EQ(facts["class_frames"], "10");
  EXPECT_EQ(facts["class_frames_incomplete"], "0");
  EXPECT_EQ(facts["packets_placed"], "245") << "20 + 21 + ... + 29";
  EXPECT_EQ(facts["packets_not_placed"], "10");
  EXPECT_EQ(facts["slices_late"], "3");
  EXPECT_EQ(facts["times_jump"], "2");
  EXPECT_EQ(facts["poses_used"], "400");
  EXPECT_NE(facts["class_run_hash"], "00000000");
  const std::string table = census.table();
  EXPECT_NE(table.find("\nclass frames          10\n"), std::string::npos) << table;
  EXPECT_NE(table.find("\nslices                50 placed, 3 late\n"), std::string::npos) << table;
  EXPECT_NE(table.find("\nposes                 400 used\n"), std::string::npos) << table;
}

TEST(StreamCensus, TellsMessagesByServiceAndEvent) {
  std::vector<std::byte> message = sample_stream().front();
  EXPECT_TRUE(StreamCensus::is_message(message));
  message[1] ^= std::byte{1};
  EXPECT_FALSE(StreamCensus::is_message(message));
  EXPECT_FALSE(StreamCensus::is_message({}));
}

}  // namespace

namespace ros {
namespace {

// Table 4.3 of the thesis and docs/model.md section 2: p of -14 is 0.057, of -7 0.197, of 2 0.599.
TEST(Percents, AreProbabilitiesOfTheRecursiveSet) {
  const Percents percents(0.05);
  EXPECT_EQ(percents[-14], 6);
  EXPECT_EQ(percents[-7], 20);
  EXPECT_EQ(percents[0], 50);
  EXPECT_EQ(percents[2], 60);
  EXPECT_EQ(percents[127], 100);
  EXPECT_EQ(percents[-127], 0);
  for (int index = 1; index <= 127; ++index) {
    EXPECT_EQ(percents[static_cast<index::OccupancyIndex>(index)] +
                  percents[static_cast<index::OccupancyIndex>(-index)],
              100)
        << index;
  }
}

// Offsets by hand from the definition: stamp 8, length and "base_link\0" 14, 2 to align, load time
// 8, resolution, width and height 12, 4 to align, pose 56, length 4; behind 4 of the encapsulation.
// A frame without indexes says no epsilon.
TEST(Percents, WithoutEpsilonAreNotKnown) {
  GridFrame frame;
  std::ranges::fill(frame.cells, 127);
  EXPECT_EQ(occupancy_grid(frame, 0, Percents(std::nullopt)).back(), std::byte{0xFF});
  EXPECT_EQ(Percents(0.01)[10], 60) << "(49/51)^10 = 0.6703";
}

TEST(OccupancyGrid, IsSerialisedAsRos2Does) {
  GridFrame frame;
  frame.cells[0] = -14;
  frame.cells[1] = 2;
  frame.cells[1024] = 127;
  const std::vector<std::byte> message = occupancy_grid(frame, 7'000'002, Percents(0.05));
  ASSERT_EQ(message.size(), 4U + 108U + 1024U * 1024U);
  const auto u32_at = [&](std::size_t at) {
    return wire::load_le32(std::span(message).subspan(4 + at).first<4>());
  };
  EXPECT_EQ(wire::load_be32(std::span(message).first<4>()), 0x00010000U) << "CDR, little endian";
  EXPECT_EQ(u32_at(0), 7U);
  EXPECT_EQ(u32_at(4), 2000U);
  EXPECT_EQ(u32_at(8), 10U);
  EXPECT_EQ(u32_at(32), 0x3DCCCCCDU) << "0.1 in single precision";
  EXPECT_EQ(u32_at(36), 1024U);
  EXPECT_EQ(u32_at(40), 1024U);
  EXPECT_EQ(u32_at(104), 1024U * 1024U);
  const std::span<const std::byte> cells = std::span(message).subspan(4 + 108);
  EXPECT_EQ(cells[0], std::byte{6});
  EXPECT_EQ(cells[1], std::byte{60});
  EXPECT_EQ(cells[2], std::byte{0xFF}) << "-1 where nothing is known";
  EXPECT_EQ(cells[1024], std::byte{100});
}

TEST(FoxgloveGrid, SaysHowOldEachCellIs) {
  constexpr std::size_t kCellBytes = 3;
  LiveGrid live;
  GridFrame frame;
  frame.header.frame_number = 10;
  frame.valid_tiles.set(0);
  frame.known_tiles.set(0);
  frame.cells[0] = -7;
  live.take(frame);
  GridFrame next;
  next.header.frame_number = 310;
  next.valid_tiles.set(1);
  live.take(next);
  const std::vector<std::byte> message = foxglove_grid(live, 0, Percents(0.05));
  const auto cells = std::span(message).last(kCellBytes * 1024 * 1024);
  const auto cell = [&](std::size_t number) {
    return std::vector(cells.begin() + static_cast<std::ptrdiff_t>(number * kCellBytes),
                       cells.begin() + static_cast<std::ptrdiff_t>((number + 1) * kCellBytes));
  };
  const auto bytes = [](std::int8_t index, std::uint8_t percent, std::uint8_t age) {
    return std::vector{static_cast<std::byte>(index), std::byte{percent}, std::byte{age}};
  };
  EXPECT_EQ(cell(0), bytes(-7, 20, 254)) << "300 frames are more than can be said";
  EXPECT_EQ(cell(32), bytes(0, 50, 0)) << "arrived, and nothing is known";
  EXPECT_EQ(cell(64), bytes(0, 50, 255)) << "never arrived";
}

// A window whose corner is at (-3.2, 6.4) m, with one cell of a class.
ClassGrid classes_of_one_cell(std::size_t cell, std::int8_t byte) {
  ClassGrid classes;
  classes.window = {.corner_a = -1, .corner_b = 2, .slices = 1};
  classes.valid_tiles.set();
  classes.cells[cell] = byte;
  return classes;
}

double f64_at(std::span<const std::byte> message, std::size_t at) {
  const std::span bytes = message.subspan(4 + at);
  const std::uint64_t low = wire::load_le32(bytes.first<4>());
  const std::uint64_t high = wire::load_le32(bytes.subspan<4, 4>());
  return std::bit_cast<double>(high << 32 | low);
}

// Offsets as of the other grid, but for "odom\0": length and text 9, 3 to align, so the load time
// is at 20, resolution, width and height at 28, the pose at 40, the length at 96.
TEST(ClassOccupancyGrid, StandsInTheLocalFrame) {
  const std::vector<std::byte> message = class_occupancy_grid(classes_of_one_cell(1024, 37), 5);
  ASSERT_EQ(message.size(), 4U + 100U + 1024U * 1024U);
  EXPECT_DOUBLE_EQ(f64_at(message, 40), -3.2);
  EXPECT_DOUBLE_EQ(f64_at(message, 48), 6.4);
  EXPECT_DOUBLE_EQ(f64_at(message, 88), 1.0) << "not turned";
  EXPECT_EQ(message[4 + 100], std::byte{0xFF}) << "-1 where nothing is known";
  EXPECT_EQ(message[4 + 100 + 1024], std::byte{90}) << "moving";
}

// nav2_map_server: below 0.196 is free, above 0.65 is occupied. Classes are those of docs/spec.md
// 3.9.
TEST(ClassOccupancyGrid, MapServersThresholdsTellFreeFromOccupied) {
  EXPECT_EQ(percent_of_class(0), -1);
  std::set<std::int8_t> values;
  for (int number = 1; number <= 8; ++number) {
    for (int sureness = 0; sureness < 8; ++sureness) {
      const std::int8_t percent = percent_of_class(static_cast<std::int8_t>(8 * number + sureness));
      values.insert(percent);
      EXPECT_TRUE(number <= 3 ? percent >= 0 && percent < 19.6 : percent > 65 && percent <= 100);
    }
  }
  EXPECT_EQ(values.size(), 8U) << "each class has a value of its own";
}

TEST(FoxgloveClassGrid, SaysClassSurenessAndAge) {
  constexpr std::size_t kCellBytes = 3;
  GridFrame frame;
  frame.classes = classes_of_one_cell(0, 8 * 7 + 3);
  frame.header.frame_number = 1;
  // The corner's tile (-1, 2) is at slot 2 * 32 + 31.
  frame.classes->age_frames.at(2 * 32 + 31) = 6;
  LiveClasses live;
  live.take(frame);
  GridFrame next = frame;
  next.header.frame_number = 2;
  next.classes->valid_tiles.reset(2 * 32 + 31);
  next.classes->window.corner_b = 3;  // the lowest row of tiles leaves the window
  live.take(next);
  next.header.frame_number = 3;
  next.classes->window.corner_b = 2;  // and comes back, but for one of its tiles
  live.take(next);
  const std::vector<std::byte> message = foxglove_class_grid(live, 5);
  const auto cells = std::span(message).last(kCellBytes * 1024 * 1024);
  EXPECT_EQ(cells[2], std::byte{255}) << "it left the window";

  LiveClasses kept;
  kept.take(frame);
  next.header.frame_number = 2;
  kept.take(next);
  const std::vector<std::byte> again = foxglove_class_grid(kept, 5);
  const auto first = std::span(again).last(kCellBytes * 1024 * 1024);
  EXPECT_EQ(first[0], std::byte{7});
  EXPECT_EQ(first[1], std::byte{3});
  EXPECT_EQ(first[2], std::byte{7}) << "six frames old when it came, a frame ago";
  EXPECT_EQ(first[kCellBytes * 32 + 2], std::byte{0}) << "the next tile is fresh";
}

// A quarter of a turn to the left is (0, 0, sqrt(1/2), sqrt(1/2)). Offsets: count 4, stamp 8,
// "odom\0" 9 and 3 to align, "base_link\0" 14, 2 to align.
TEST(TfMessage, TurnsAndMoves) {
  const std::vector<std::byte> message =
      transform_of({.x_mm = -1500, .y_mm = 250, .heading = 1U << 30}, 7'000'002);
  ASSERT_EQ(message.size(), 4U + 40U + 56U);
  EXPECT_EQ(wire::load_le32(std::span(message).subspan<8, 4>()), 7U) << "seconds";
  EXPECT_DOUBLE_EQ(f64_at(message, 40), -1.5);
  EXPECT_DOUBLE_EQ(f64_at(message, 48), 0.25);
  EXPECT_DOUBLE_EQ(f64_at(message, 64), 0.0);
  EXPECT_NEAR(f64_at(message, 80), std::sqrt(0.5), 1e-15);
  EXPECT_NEAR(f64_at(message, 88), std::sqrt(0.5), 1e-15);
}

// A frame whose pose is not known moves no frame of a recording to the origin.
TEST(TfMessage, IsOnlyOfAPlaceThatIsKnown) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "poses.mcap";
  McapRecording recording(path, {std::string(kTransformTopic)}, mcap::Compression::kNone);
  GridFrame frame;
  frame.classes = classes_of_one_cell(0, 8);
  const LiveGrid live;
  const LiveClasses live_classes;
  const pose::Pose pose{.x_mm = 1'000, .y_mm = 0, .heading = 0};
  for (const stream::ClassWindow& window :
       {stream::ClassWindow{.pose = pose, .sigma = {20, 30}, .slices = 5},
        stream::ClassWindow{.slices = 5}, stream::ClassWindow{},
        stream::ClassWindow{.pose = pose, .sigma = {20, 30}, .slices = 1}}) {
    frame.classes->window = window;
    recording.take_frame({.frame = &frame, .live = &live, .classes = &live_classes});
  }
  recording.finish({});
  std::ifstream in(path, std::ios::binary);
  mcap::Reader reader(in);
  int count = 0;
  while (const std::optional<mcap::Message> message = reader.next()) {
    EXPECT_DOUBLE_EQ(f64_at(message->data, 40), 1.0);
    ++count;
  }
  EXPECT_EQ(count, 2);
}

TEST(Uint8MultiArray, CarriesAnyBytes) {
  for (const std::size_t size : {0U, 1U, 3U, 1392U}) {
    const std::vector<std::byte> bytes(size, std::byte{0xA5});
    const std::vector<std::byte> message = uint8_multi_array(bytes);
    EXPECT_EQ(message.size(), 4U + 12U + size);
    const auto read = bytes_of_uint8_multi_array(message);
    ASSERT_TRUE(read.has_value());
    EXPECT_TRUE(std::ranges::equal(*read, bytes));
    EXPECT_FALSE(bytes_of_uint8_multi_array(std::span(message).first(15)).has_value());
  }
}

TEST(Uint8MultiArray, OneWithALayoutOrTheOtherByteOrderIsNotRead) {
  std::vector<std::byte> message = uint8_multi_array(std::vector<std::byte>(5));
  message[4] = std::byte{1};
  EXPECT_FALSE(bytes_of_uint8_multi_array(message).has_value());
  message[4] = std::byte{0};
  message[1] = std::byte{0};
  EXPECT_FALSE(bytes_of_uint8_multi_array(message).has_value());
}

}  // namespace
}  // namespace ros
}  // namespace iog::tools
