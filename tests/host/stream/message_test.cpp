// The messages, byte by byte as docs/spec.md lists them, and what a receiver must survive.
#include "stream/message.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/bytes_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::stream {
namespace {

using tests::bytes_of;

const Header kHeader{.type = MessageType::kTile,
                     .sequence = 0x01020304,
                     .frame_number = 0x05060708,
                     .closed_us = 0x1112131415161718,
                     .vehicle_id = 0x21222324,
                     .sensor_count = 4,
                     .complete_sensors = 0x0B,
                     .partial_sensors = 0x04,
                     .flags = kFlagTimedOut,
                     .points_used = 0x31323334,
                     .points_other = 0x41424344,
                     .packets_fused = 0x51525354,
                     .packets_dropped = 0x61626364};

const std::vector<std::byte> kHeaderWire =
    bytes_of({'I',  'O',  'G',  'R',  1,    1,    0,    48,   0x01, 0x02, 0x03, 0x04,
              0x05, 0x06, 0x07, 0x08, 0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18,
              0x21, 0x22, 0x23, 0x24, 4,    0x0B, 0x04, 0x01, 0x31, 0x32, 0x33, 0x34,
              0x41, 0x42, 0x43, 0x44, 0x51, 0x52, 0x53, 0x54, 0x61, 0x62, 0x63, 0x64});

TEST(Message, TheHeaderIsAsTheSpecificationSays) {
  std::vector<std::byte> wire(kHeaderBytes);
  ASSERT_EQ(write_header(kHeader, wire), kHeaderBytes);
  EXPECT_EQ(wire, kHeaderWire);

  Header read;
  std::span<const std::byte> body;
  ASSERT_EQ(read_header(wire, read, body), ReadStatus::kOk);
  EXPECT_TRUE(body.empty());
  EXPECT_EQ(read.sequence, kHeader.sequence);
  EXPECT_EQ(read.frame_number, kHeader.frame_number);
  EXPECT_EQ(read.closed_us, kHeader.closed_us);
  EXPECT_EQ(read.complete_sensors, kHeader.complete_sensors);
  EXPECT_EQ(read.packets_dropped, kHeader.packets_dropped);
}

TEST(Message, ALongerHeaderOfALaterDayIsSkipped) {
  auto wire = kHeaderWire;
  wire.at(7) = std::byte{52};
  wire.insert(wire.end(), {std::byte{9}, std::byte{9}, std::byte{9}, std::byte{9}, std::byte{42}});
  Header read;
  std::span<const std::byte> body;
  ASSERT_EQ(read_header(wire, read, body), ReadStatus::kOk);
  ASSERT_EQ(body.size(), 1U);
  EXPECT_EQ(body[0], std::byte{42});
}

TEST(Message, StrangersAndOtherVersionsAreRefused) {
  Header read;
  std::span<const std::byte> body;
  auto wire = kHeaderWire;
  wire.at(0) = std::byte{0};
  EXPECT_EQ(read_header(wire, read, body), ReadStatus::kNotOurs);
  wire = kHeaderWire;
  wire.at(4) = std::byte{2};
  EXPECT_EQ(read_header(wire, read, body), ReadStatus::kOtherVersion);
  wire = kHeaderWire;
  wire.at(7) = std::byte{47};
  EXPECT_EQ(read_header(wire, read, body), ReadStatus::kTooShort);
  for (std::size_t size = 0; size < kHeaderBytes; ++size) {
    EXPECT_EQ(read_header(std::span(kHeaderWire).first(size), read, body), ReadStatus::kTooShort);
  }
}

std::vector<std::byte> tile_wire() {
  auto wire = bytes_of({0, 3,   0, 31, 5,    0,    0,    0,    4,    0,    4,    0,
                        0, 100, 4, 0,  0xFF, 0xFF, 0x38, 0x00, 0xFF, 0xFF, 0x38, 0x00});
  wire.resize(wire.size() + 1024, std::byte{7});
  return wire;
}

TEST(Message, ATileIsAsTheSpecificationSays) {
  const TileHeader tile{.tile_x = 3,
                        .tile_y = 31,
                        .side_log2 = 5,
                        .grid_width = 1024,
                        .grid_height = 1024,
                        .cell_mm = 100,
                        .payload_bytes = 1024,
                        .origin_x_mm = -51'200,
                        .origin_y_mm = -51'200};
  std::vector<std::byte> wire(kTileHeaderBytes);
  ASSERT_EQ(write_tile_header(tile, wire), kTileHeaderBytes);
  const auto expected = tile_wire();
  EXPECT_TRUE(std::equal(wire.begin(), wire.end(), expected.begin()));

  TileHeader read;
  std::span<const std::byte> payload;
  ASSERT_EQ(read_tile(expected, read, payload), ReadStatus::kOk);
  EXPECT_EQ(read.tile_x, 3);
  EXPECT_EQ(read.tile_y, 31);
  EXPECT_EQ(read.origin_x_mm, -51'200);
  EXPECT_EQ(payload.size(), 1024U);
}

TEST(Message, ATileThatLiesOutsideItsGridOrIsNotAsLongAsItSaysIsRefused) {
  TileHeader read;
  std::span<const std::byte> payload;
  const auto status_with = [&](std::size_t at, int value) {
    auto wire = tile_wire();
    wire.at(at) = static_cast<std::byte>(value);
    return read_tile(wire, read, payload);
  };
  EXPECT_EQ(status_with(1, 31), ReadStatus::kOk);
  EXPECT_EQ(status_with(1, 32), ReadStatus::kInconsistent);
  EXPECT_EQ(status_with(0, 0xFF), ReadStatus::kInconsistent);
  EXPECT_EQ(status_with(4, 6), ReadStatus::kInconsistent);
  EXPECT_EQ(status_with(4, 255), ReadStatus::kInconsistent);
  EXPECT_EQ(status_with(14, 3), ReadStatus::kInconsistent);
  auto longer = tile_wire();
  longer.push_back(std::byte{0});
  EXPECT_EQ(read_tile(longer, read, payload), ReadStatus::kInconsistent);
  const auto wire = tile_wire();
  EXPECT_EQ(read_tile(std::span(wire).first(23), read, payload), ReadStatus::kTooShort);
}

FrameEnd some_frame_end() {
  FrameEnd end{.tiles_sent = 241, .tiles_lost = 2, .grid_crc = 0xDEADBEEF, .opened_us = 123456};
  end.stopwatch_hz = 100'000'000;
  end.ticks = {.fuse = 1, .mark = 2, .publish = 3};
  end.fates = {10, 11, 12, 13, 14, 15, 16, 17};
  end.packet_drops = {20, 21, 22, 23, 24, 25, 26, 27};
  end.link_counter_count = 3;
  end.link_counters[2] = 99;
  end.sensors[1] = {.state = SensorState::kPartial,
                    .age_frames = 7,
                    .packets = 3,
                    .points = 420,
                    .scan_number = 65'535};
  return end;
}

TEST(Message, AFrameEndSurvivesTheWire) {
  std::vector<std::byte> wire(kMaxMessageBytes - kHeaderBytes);
  const std::size_t bytes = write_frame_end(some_frame_end(), 2, wire);
  ASSERT_GT(bytes, 0U);
  FrameEnd read;
  ASSERT_EQ(read_frame_end(std::span(wire).first(bytes), 2, read), ReadStatus::kOk);
  EXPECT_EQ(read.tiles_sent, 241U);
  EXPECT_EQ(read.tiles_lost, 2U);
  EXPECT_EQ(read.grid_crc, 0xDEADBEEFU);
  EXPECT_EQ(read.opened_us, 123456U);
  EXPECT_EQ(read.ticks.publish, 3U);
  EXPECT_EQ(read.fates[7], 17U);
  EXPECT_EQ(read.packet_drops[7], 27U);
  EXPECT_EQ(read.link_counters[2], 99U);
  EXPECT_EQ(read.sensors[1].points, 420U);
  EXPECT_EQ(read.sensors[1].scan_number, 65'535U);
  EXPECT_EQ(read.sensors[1].state, SensorState::kPartial);
  for (std::size_t size = 0; size < bytes; ++size) {
    EXPECT_EQ(read_frame_end(std::span(wire).first(size), 2, read), ReadStatus::kTooShort);
  }
}

TEST(Message, TheLongestFrameEndFitsAMessage) {
  FrameEnd end = some_frame_end();
  end.link_counter_count = kMaxLinkCounters;
  std::vector<std::byte> wire(kMaxMessageBytes - kHeaderBytes);
  EXPECT_GT(write_frame_end(end, vehicle::kMaxSensors, wire), 0U);
}

TEST(Message, ReadingIsTotalOnGarbage) {
  tests::Random random(61);
  for (int i = 0; i < tests::effort(200'000, 3'000); ++i) {
    std::vector<std::byte> wire = kHeaderWire;
    wire.at(5) = static_cast<std::byte>(random.between(0, 3));
    const int length = random.between(0, 300);
    for (int j = 0; j < length; ++j) {
      wire.push_back(static_cast<std::byte>(random.next()));
    }
    Header header;
    std::span<const std::byte> body;
    if (read_header(wire, header, body) == ReadStatus::kOk) {
      TileHeader tile;
      std::span<const std::byte> payload;
      if (read_tile(body, tile, payload) == ReadStatus::kOk) {
        ASSERT_EQ(payload.size(), tile.payload_bytes);
      }
      FrameEnd end;
      if (read_frame_end(body, static_cast<std::uint8_t>(random.next()), end) == ReadStatus::kOk) {
        ASSERT_LE(end.link_counter_count, kMaxLinkCounters);
      }
    }
  }
}

}  // namespace
}  // namespace iog::stream
