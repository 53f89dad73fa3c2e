#include <set>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "pose/message.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/replay/frame_grouper.hpp"
#include "tools/replay/port_queue.hpp"
#include "tools/replay/pose_rounds.hpp"

namespace iog::tools {
namespace {

using Frames = std::vector<std::vector<CapturedDatagram>>;

Frames grouped(const CatalogueEntry& car, const std::vector<CapturedDatagram>& datagrams) {
  std::size_t next = 0;
  FrameGrouper grouper(*car.vehicle, [&]() -> std::optional<CapturedDatagram> {
    return next < datagrams.size() ? std::optional(datagrams[next++]) : std::nullopt;
  });
  Frames frames;
  for (auto frame = grouper.next(); !frame.empty(); frame = grouper.next()) {
    frames.push_back(std::move(frame));
  }
  return frames;
}

// The frames with evidence, each by its packets.
std::vector<std::uint32_t> packets_by_frame(const CatalogueEntry& car,
                                            const std::vector<CapturedDatagram>& datagrams) {
  std::vector<std::uint32_t> packets;
  FrameAssembler assembler([&](const GridFrame& frame) {
    if (frame.header.has_evidence()) {
      packets.push_back(frame.header.packets_fused);
    }
  });
  for (const auto& message : messages_of(car, datagrams)) {
    assembler.take(message);
  }
  assembler.finish();
  return packets;
}

void expect_the_frames_of_fuse(const CatalogueEntry& car,
                               const std::vector<CapturedDatagram>& datagrams) {
  const Frames frames = grouped(car, datagrams);
  const std::vector<std::uint32_t> packets = packets_by_frame(car, datagrams);
  ASSERT_EQ(frames.size(), packets.size());
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_EQ(frames[i].size(), packets[i]) << "frame " << i;
  }
}

TEST(FrameGrouper, GroupsAreTheFramesOfFuse) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const auto datagrams = sample_drive(car, 1, 6);
  expect_the_frames_of_fuse(car, datagrams);
  EXPECT_EQ(grouped(car, datagrams).size(), 6U);
}

// Without sensor 3 every frame ends by time or by the next scan.
TEST(FrameGrouper, FramesThatNeverCompleteAreCutWhereFuseCutsThem) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  auto datagrams = sample_drive(car, 1, 6);
  const std::uint16_t silent = car.sensors[3].udp_port;
  std::erase_if(datagrams, [&](const CapturedDatagram& datagram) {
    return datagram.destination.port == silent;
  });
  expect_the_frames_of_fuse(car, datagrams);
  // The same packets without pauses: only the next scan ends a frame.
  for (CapturedDatagram& datagram : datagrams) {
    datagram.time_us = 0;
  }
  expect_the_frames_of_fuse(car, datagrams);
}

TEST(FrameGrouper, NothingIsLostAndOrderIsKept) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const auto datagrams = sample_drive(car, 1, 3);
  std::size_t next = 0;
  for (const auto& frame : grouped(car, datagrams)) {
    for (const CapturedDatagram& datagram : frame) {
      EXPECT_EQ(datagram.payload, datagrams.at(next++).payload);
    }
  }
  EXPECT_EQ(next, datagrams.size());
}

// A pose cuts no frame and is lost in none: it goes with the packets among which it came.
TEST(FrameGrouper, PosesStayWhereTheyCame) {
  const CatalogueEntry& car = find_vehicle("reference_car");
  const auto packets = sample_drive(car, 1, 3);
  pose::Encoder encoder;
  const auto bytes = encoder.encode({.run = 1});
  std::vector<CapturedDatagram> datagrams;
  for (const CapturedDatagram& packet : packets) {
    datagrams.push_back(packet);
    CapturedDatagram pose = packet;
    pose.destination.port = car.vehicle->poses.udp_port;
    pose.payload.assign(bytes.begin(), bytes.end());
    datagrams.push_back(pose);
  }
  const Frames frames = grouped(car, datagrams);
  const Frames without = grouped(car, packets);
  ASSERT_EQ(frames.size(), without.size() + 1);  // the pose behind the last packet
  EXPECT_EQ(frames.back().size(), 1U);
  for (std::size_t i = 0; i < without.size(); ++i) {
    // The first frame has no pose in front of it.
    EXPECT_EQ(frames[i].size(), 2 * without[i].size() - (i == 0 ? 1 : 0)) << i;
  }
}

TEST(PoseRounds, EachRoundIsAnotherRunAndNothingElse) {
  pose::Encoder encoder;
  PoseRounds rounds;
  const pose::Message recorded{.run = 7,
                               .age_us = 1'000,
                               .clock_us = 1'000'000,
                               .pose = {.x_mm = 1, .y_mm = 2, .heading = 3},
                               .sigma = {10, 20}};
  const auto encoded = encoder.encode(recorded);
  const std::vector<std::byte> bytes(encoded.begin(), encoded.end());
  rounds.start_round();
  EXPECT_EQ(rounds.in_round(bytes), bytes);
  std::set<std::uint32_t> runs{recorded.run};
  for (int round = 2; round <= 5; ++round) {
    rounds.start_round();
    auto [fate, message] = pose::decode(rounds.in_round(bytes));
    ASSERT_EQ(fate, pose::Fate::kUsed);
    EXPECT_TRUE(runs.insert(message.run).second) << round;
    message.run = recorded.run;
    EXPECT_EQ(message, recorded);
  }
  std::vector<std::byte> damaged = bytes;
  damaged.back() ^= std::byte{1};
  EXPECT_EQ(rounds.in_round(damaged), damaged);
}

// Two lines of Linux 6.1: 900 bytes and 1 byte wait in the first port, and nothing in the second.
TEST(PortQueue, IsReadFromTheSystemsTable) {
  const std::vector<std::string> lines{
      "   sl  local_address rem_address   st tx_queue rx_queue tr tm->when retrnsmt   uid  timeout "
      "inode ref pointer drops",
      " 1159: 0100007F:9585 00000000:0000 07 00000000:00000C40 00:00000000 00000000     0        0 "
      "120552 2 000000001081fb51 0",
      "15595: 00000000:CDE9 00000000:0000 07 00000000:00000000 00:00000000 00000000     0        0 "
      "120553 2 00000000f00f0d70 0"};
  constexpr std::uint32_t kThisPc = 0x0100'007F;  // 127.0.0.1 as a PC reads it
  EXPECT_EQ(bytes_waiting(lines, kThisPc, 0x9585), 0xC40U);
  EXPECT_EQ(bytes_waiting(lines, kThisPc, 0xCDE9), 0U) << "bound to all addresses";
  EXPECT_EQ(bytes_waiting(lines, kThisPc + 1, 0x9585), std::nullopt) << "another address";
  EXPECT_EQ(bytes_waiting(lines, kThisPc, 0x9586), std::nullopt) << "nobody listens";
  EXPECT_EQ(bytes_waiting({}, kThisPc, 0x9585), std::nullopt) << "no such table";
}

}  // namespace
}  // namespace iog::tools
