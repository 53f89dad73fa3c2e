// Points are read from a capture in the frames that `iog fuse` makes of it, whatever has happened
// to the capture: the grids that follow from them are those that the target's pipeline sends.
#include "lab/evidence/frame_points.hpp"

#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <utility>

#include "fakes/ground_car.hpp"
#include "fakes/random.hpp"
#include "fakes/temporary_folder.hpp"
#include "fakes/velodyne_packet.hpp"
#include "lab/evidence/fusion_rules.hpp"
#include "lab/evidence/projection.hpp"
#include "lab/evidence/values.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/frames/frame_assembler.hpp"
#include "tools/fuse/offline_target.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::lab {
namespace {

using Grids = std::vector<std::vector<std::int32_t>>;
using Datagrams = std::vector<tools::CapturedDatagram>;

// The frames with evidence of the target's own pipeline.
Grids grids_of_target(const tools::CatalogueEntry& car, const Datagrams& datagrams) {
  Grids grids;
  tools::FrameAssembler assembler([&](const tools::GridFrame& frame) {
    if (frame.header.has_evidence()) {
      grids.emplace_back(frame.cells.begin(), frame.cells.end());
    }
  });
  const auto target = std::make_unique<tools::OfflineTarget>(
      *car.vehicle, [&](std::span<const std::byte> message) { assembler.take(message); });
  for (const tools::CapturedDatagram& datagram : datagrams) {
    if (tools::sensor_of_port(car, datagram.destination.port) < car.sensors.size()) {
      static_cast<void>(target->take(datagram));
    }
  }
  target->finish();
  assembler.finish();
  return grids;
}

std::vector<FramePoints> read_back(const tools::CatalogueEntry& car, const Datagrams& datagrams) {
  const tests::TemporaryFolder folder;
  const std::string path = folder / "points.pcap";
  tools::PcapWriter writer(path);
  for (const tools::CapturedDatagram& datagram : datagrams) {
    writer.write(datagram);
  }
  writer.finish();
  return read_points(path, car);
}

Grids grids_of_points(const tools::CatalogueEntry& car, const std::vector<FramePoints>& frames) {
  const auto values = indexes(probabilities({}), 0.05, index::Quantisation::kBlurring);
  Grids grids;
  for (const FramePoints& points : frames) {
    grids.push_back(
        fuse_indexes(project(*car.vehicle, points, {}), values, IndexRule::kHitsWin, 127));
  }
  return grids;
}

Datagrams drive_of(const tools::CatalogueEntry& car, std::uint32_t frames) {
  tools::Drive drive(car, 3, 1);
  Datagrams datagrams;
  for (std::uint32_t frame = 0; frame < frames; ++frame) {
    for (tools::CapturedDatagram& datagram : drive.datagrams(frame)) {
      datagrams.push_back(std::move(datagram));
    }
  }
  return datagrams;
}

TEST(FramePoints, ADriveHasTheFramesOfTheTarget) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  const Datagrams datagrams = drive_of(car, 4);
  const auto frames = read_back(car, datagrams);
  ASSERT_EQ(frames.size(), 4U);
  EXPECT_EQ(grids_of_points(car, frames), grids_of_target(car, datagrams));
}

// Lost, repeated, exchanged and damaged datagrams, those of other ports, and a pause.
Datagrams disturbed(Datagrams datagrams, std::uint64_t seed) {
  tests::Random random(seed);
  Datagrams result;
  std::uint64_t late_us = 0;
  for (tools::CapturedDatagram& datagram : datagrams) {
    late_us += random.one_in(30) ? 100'000U : 0U;
    datagram.time_us += late_us;
    if (random.one_in(9)) {
      continue;
    }
    result.push_back(datagram);
    if (random.one_in(9)) {
      result.push_back(datagram);
    }
    if (random.one_in(9) && result.size() > 3) {
      std::swap(result.back().payload, result[result.size() - 3].payload);
      std::swap(result.back().destination, result[result.size() - 3].destination);
    }
    if (random.one_in(9)) {
      result.back().payload[random.below(result.back().payload.size())] ^= std::byte{0x40};
    }
    if (random.one_in(9)) {
      result.push_back(datagram);
      result.back().destination.port = 99;
    }
  }
  return result;
}

TEST(FramePoints, ADisturbedDriveHasTheFramesOfTheTarget) {
  const tools::CatalogueEntry& car = tools::find_vehicle("two_lux_parking");
  for (const std::uint64_t seed : {1U, 2U}) {
    const Datagrams datagrams = disturbed(drive_of(car, 8), seed);
    const auto frames = read_back(car, datagrams);
    EXPECT_GT(frames.size(), 4U);
    EXPECT_EQ(grids_of_points(car, frames), grids_of_target(car, datagrams));
  }
}

// Two turns of a VLP-16 and the start of a third. Points one by one are judged by the height band.
TEST(FramePoints, ATurnOfAVlp16IsAFrame) {
  tools::CatalogueEntry car = tools::find_vehicle("roof_vlp16");
  const tests::GroundCar flat(*car.vehicle, {});
  car.vehicle = &flat.vehicle();
  tests::Random random(7);
  Datagrams datagrams;
  for (int number = 0; number < 170; ++number) {
    const auto time_us = static_cast<std::uint32_t>(number) * 1327;
    tests::VelodynePacket packet{.first_azimuth = number * 478 % 36'000, .time_us = time_us};
    for (auto& block : packet.ranges) {
      for (int& range : block) {
        range = random.one_in(9) ? random.between(600, 20'000) : 0;
      }
    }
    datagrams.push_back({.time_us = 1'000'000 + time_us,
                         .source = {1, 2368},
                         .destination = {2, 2368},
                         .payload = packet.bytes()});
  }
  const auto frames = read_back(car, datagrams);
  EXPECT_EQ(frames.size(), 3U);
  EXPECT_EQ(grids_of_points(car, frames), grids_of_target(car, datagrams));
}

// The simulator loses nothing on the way: what it sends is what is read back.
TEST(FramePoints, ADriveNeedsNoCapture) {
  const tools::CatalogueEntry& car = tools::find_vehicle("reference_car");
  const auto frames = read_back(car, drive_of(car, 3));
  tools::Drive drive(car, 3, 1);
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    const FramePoints direct = points_of(drive, frame, car);
    ASSERT_EQ(direct.size(), frames[frame].size());
    for (std::size_t i = 0; i < direct.size(); ++i) {
      ASSERT_EQ(direct[i].sensor, frames[frame][i].sensor);
      ASSERT_EQ(direct[i].point.range_mm, frames[frame][i].point.range_mm);
      ASSERT_EQ(direct[i].point.azimuth_ticks, frames[frame][i].point.azimuth_ticks);
    }
  }
}

TEST(FramePoints, AMissingCaptureIsSaid) {
  const tests::TemporaryFolder folder;
  EXPECT_THROW(
      static_cast<void>(read_points(folder / "missing.pcap", tools::find_vehicle("reference_car"))),
      tools::UsageError);
}

}  // namespace
}  // namespace iog::lab
