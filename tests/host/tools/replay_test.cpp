#include <memory>
#include <vector>

#include "gtest/gtest.h"

#include "drive_sample.hpp"
#include "tools/receive/frame_assembler.hpp"
#include "tools/receive/frame_record.hpp"
#include "tools/replay/frame_grouper.hpp"

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

}  // namespace
}  // namespace iog::tools
