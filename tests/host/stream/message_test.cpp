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

const Header kHeader{.type = MessageType::kFrameEnd,
                     .flags = kFlagTimedOut,
                     .sequence = 0x01020304,
                     .frame_number = 0x05060708,
                     .closed_us = 0x1112131415161718,
                     .vehicle_id = 0x21222324,
                     .sensor_count = 4,
                     .complete_sensors = 0x0B,
                     .partial_sensors = 0x04,
                     .points_used = 0x31323334,
                     .points_other = 0x41424344,
                     .packets_fused = 0x51525354,
                     .packets_dropped = 0x61626364,
                     .run_number = 0x71727374};

const std::vector<std::byte> kHeaderWire =
    tests::bytes_of({2,    1,    0,    48,   0x01, 0x02, 0x03, 0x04, 0x05, 0x06, 0x07, 0x08,
                     0x11, 0x12, 0x13, 0x14, 0x15, 0x16, 0x17, 0x18, 0x21, 0x22, 0x23, 0x24,
                     4,    0x0B, 0x04, 0,    0x31, 0x32, 0x33, 0x34, 0x41, 0x42, 0x43, 0x44,
                     0x51, 0x52, 0x53, 0x54, 0x61, 0x62, 0x63, 0x64, 0x71, 0x72, 0x73, 0x74});

TEST(Message, TheHeaderIsAsTheSpecificationSays) {
  std::vector<std::byte> wire(kHeaderBytes);
  ASSERT_EQ(write_header(kHeader, wire), kHeaderBytes);
  EXPECT_EQ(wire, kHeaderWire);

  Header read;
  std::span<const std::byte> body;
  ASSERT_EQ(read_header(wire, read, body), ReadStatus::kOk);
  EXPECT_TRUE(body.empty());
  EXPECT_EQ(read.type, kHeader.type);
  EXPECT_EQ(read.flags, kHeader.flags);
  EXPECT_EQ(read.sequence, kHeader.sequence);
  EXPECT_EQ(read.frame_number, kHeader.frame_number);
  EXPECT_EQ(read.closed_us, kHeader.closed_us);
  EXPECT_EQ(read.complete_sensors, kHeader.complete_sensors);
  EXPECT_EQ(read.packets_dropped, kHeader.packets_dropped);
  EXPECT_EQ(read.run_number, kHeader.run_number);
}

TEST(Message, ALongerHeaderOfALaterDayIsSkipped) {
  auto wire = kHeaderWire;
  wire.at(3) = std::byte{52};
  wire.insert(wire.end(), {std::byte{9}, std::byte{9}, std::byte{9}, std::byte{9}, std::byte{42}});
  Header read;
  std::span<const std::byte> body;
  ASSERT_EQ(read_header(wire, read, body), ReadStatus::kOk);
  ASSERT_EQ(body.size(), 1U);
  EXPECT_EQ(body[0], std::byte{42});
}

TEST(Message, AShorterHeaderIsRefused) {
  Header read;
  std::span<const std::byte> body;
  auto wire = kHeaderWire;
  wire.at(3) = std::byte{47};
  EXPECT_EQ(read_header(wire, read, body), ReadStatus::kTooShort);
  for (std::size_t size = 0; size < kHeaderBytes; ++size) {
    EXPECT_EQ(read_header(std::span(kHeaderWire).first(size), read, body), ReadStatus::kTooShort);
  }
}

FrameEnd some_frame_end() {
  FrameEnd end{.tiles_sent = 241, .tiles_lost = 2, .grid_crc = 0xDEADBEEF, .opened_us = 123456};
  end.stopwatch_hz = 100'000'000;
  end.ticks = {.fuse = 1, .mark = 2, .publish = 3, .perceive = 4};
  end.fates = {10, 11, 12, 13, 14, 15, 16, 17};
  end.packet_drops = {20, 21, 22, 23, 24, 25, 26, 27, 28};
  end.link_counter_count = 3;
  end.link_counters[2] = 99;
  end.sensors[1] = {.state = intake::SensorState::kPartial,
                    .blocked = intake::Blocked::kPartly,
                    .age_frames = 7,
                    .packets = 3,
                    .points = 420,
                    .scan_number = 65'535};
  end.unwatched = 0x0123'4567'89AB'CDEF;
  end.blocked = 0x0000'0100'0000'0002;
  end.temperature_dc = -401;
  return end;
}

TEST(Message, AFrameEndSurvivesTheWire) {
  std::vector<std::byte> wire(protection::kMaxContentBytes - kHeaderBytes);
  const std::size_t bytes = write_frame_end(some_frame_end(), 2, wire);
  ASSERT_GT(bytes, 0U);
  FrameEnd read;
  ASSERT_EQ(read_frame_end(std::span(wire).first(bytes), 2, read), ReadStatus::kOk);
  EXPECT_EQ(read.tiles_sent, 241U);
  EXPECT_EQ(read.tiles_lost, 2U);
  EXPECT_EQ(read.grid_crc, 0xDEADBEEFU);
  EXPECT_EQ(read.opened_us, 123456U);
  EXPECT_EQ(read.ticks.publish, 3U);
  EXPECT_EQ(read.ticks.perceive, 4U);
  EXPECT_EQ(read.fates[7], 17U);
  EXPECT_EQ(read.packet_drops[8], 28U);
  EXPECT_EQ(read.link_counters[2], 99U);
  EXPECT_EQ(read.sensors[1].points, 420U);
  EXPECT_EQ(read.sensors[1].scan_number, 65'535U);
  EXPECT_EQ(read.sensors[1].state, intake::SensorState::kPartial);
  for (std::size_t size = 0; size < bytes; ++size) {
    EXPECT_EQ(read_frame_end(std::span(wire).first(size), 2, read), ReadStatus::kTooShort);
  }
}

// docs/spec.md 3.5: 64 bits behind the sensors, and 64 more, then tenths of a degree Celsius. A
// later version may have more.
TEST(Message, AFrameEndSaysWhatIsNotWatchedWhatIsBlockedAndHowWarmTheChipIs) {
  std::vector<std::byte> wire(protection::kMaxContentBytes - kHeaderBytes);
  const std::size_t bytes = write_frame_end(some_frame_end(), 2, wire);
  const auto tail = std::span(wire).first(bytes).last<24>();
  constexpr std::array kExpected{0x01, 0x23, 0x45, 0x67, 0x89, 0xAB, 0xCD, 0xEF, 0, 0, 1, 0,
                                 0,    0,    0,    2,    0xFE, 0x6F, 0,    0,    0, 0, 0, 0};
  EXPECT_TRUE(std::ranges::equal(tail, kExpected, {}, std::to_integer<int>));
  EXPECT_EQ(wire.at(bytes - 24 - 15), std::byte{0x01}) << "behind the state of the last sensor";
  FrameEnd read;
  ASSERT_EQ(read_frame_end(std::span(wire).first(bytes + 3), 2, read), ReadStatus::kOk);
  EXPECT_EQ(read.unwatched, 0x0123'4567'89AB'CDEFU);
  EXPECT_EQ(read.blocked, 0x0000'0100'0000'0002U);
  EXPECT_EQ(read.temperature_dc, -401);
  EXPECT_EQ(read.sensors[0].blocked, intake::Blocked::kNot);
  EXPECT_EQ(read.sensors[1].blocked, intake::Blocked::kPartly);
}

TEST(Message, TheLongestFrameEndFitsAMessage) {
  FrameEnd end = some_frame_end();
  end.link_counter_count = kMaxLinkCounters;
  std::vector<std::byte> wire(protection::kMaxContentBytes - kHeaderBytes);
  const std::size_t bytes = write_frame_end(end, vehicle::kMaxSensors, wire);
  ASSERT_GT(bytes, 0U);
  FrameEnd read;
  const auto status_of = [&](std::uint8_t sensors) {
    return read_frame_end(std::span(wire).first(bytes), sensors, read);
  };
  EXPECT_EQ(status_of(vehicle::kMaxSensors), ReadStatus::kOk);
  EXPECT_EQ(status_of(vehicle::kMaxSensors + 1), ReadStatus::kInconsistent) << "there is no place";
}

// docs/spec.md 3.2: a frame of which no sensor had anything has no evidence.
TEST(Message, OneSensorIsEvidence) {
  EXPECT_FALSE(Header{}.has_evidence());
  EXPECT_TRUE(Header{.complete_sensors = 1}.has_evidence());
  EXPECT_TRUE(Header{.partial_sensors = 0x80}.has_evidence());
}

TEST(Message, ReadingIsTotalOnGarbage) {
  tests::Random random(61);
  for (int i = 0; i < tests::effort(200'000, 3'000); ++i) {
    std::vector<std::byte> wire = kHeaderWire;
    const int length = random.between(0, 300);
    for (int j = 0; j < length; ++j) {
      wire.push_back(static_cast<std::byte>(random.next()));
    }
    Header header;
    std::span<const std::byte> body;
    if (read_header(wire, header, body) == ReadStatus::kOk) {
      FrameEnd end;
      if (read_frame_end(body, static_cast<std::uint8_t>(random.next()), end) == ReadStatus::kOk) {
        ASSERT_LE(end.link_counter_count, kMaxLinkCounters);
      }
    }
  }
}

}  // namespace
}  // namespace iog::stream
