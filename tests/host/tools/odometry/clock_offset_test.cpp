// A log whose clock is behind, beside the packets of the same simulated drive.
#include <cmath>
#include <cstdlib>
#include <optional>
#include <string>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "pose/message.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/identity/car_capture.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/simulate/drives/drive.hpp"
#include "tools/simulate/drives/pose_source.hpp"

namespace iog::tools {
namespace {

// The packets of the drive, and its poses as a log by a clock that is half a second behind.
DriveFiles recorded(const tests::TemporaryFolder& folder, const CatalogueEntry& car,
                    std::string_view scene, std::uint32_t seconds) {
  Drive drive(car, 1, seconds, find_scene(scene), Motion::kContinuous);
  PcapWriter packets(folder / "packets.pcap");
  for (std::uint32_t frame = 0; frame < drive.frame_count(); ++frame) {
    for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
      packets.write(datagram);
    }
  }
  std::string log = "time_s,x_m,y_m,heading_deg\n";
  for (const PoseSample& pose : simulated_poses(drive.scene(), {}, 1, seconds)) {
    log += std::to_string(static_cast<double>(pose.time_us) / 1e6 - 0.5) + ',' +
           std::to_string(pose.x_m) + ',' + std::to_string(pose.y_m) + ',' +
           std::to_string(pose.heading_rad / kRadians) + '\n';
  }
  packets.finish();
  OutputFile file(folder / "log.csv");
  file.write(log);
  file.finish();
  return {.captures = {folder / "packets.pcap"},
          .poses = folder / "log.csv",
          .finds_clock_offset = true};
}

// Each pose comes, and says that it was measured, half a second later than in the log.
TEST(ClockOffset, IsThatOfTheDrive) {
  const tests::TemporaryFolder folder;
  const CatalogueEntry& car = find_vehicle("roof_vlp16");
  CarCapture capture(recorded(folder, car, "street", 8), car);
  std::uint64_t poses = 0;
  while (const std::optional<CapturedDatagram> datagram = capture.next()) {
    const auto [fate, pose] = pose::decode(datagram->payload);
    if (datagram->destination.port == pose::kPosePort) {
      ASSERT_EQ(fate, pose::Fate::kUsed);
      EXPECT_LT(
          std::abs(static_cast<double>(pose.clock_us) - static_cast<double>(datagram->time_us)),
          1e3);
      ++poses;
    }
  }
  EXPECT_GT(poses, 700U);
  EXPECT_EQ(capture.clock_words(), "");
  const std::string said = capture.remarks().back();
  const std::string begin = "by their motion, the packets are ";
  ASSERT_TRUE(said.starts_with(begin)) << said;
  EXPECT_NEAR(std::stod(said.substr(begin.size())), 0.5, 0.02);
}

TEST(ClockOffset, NeedsALog) {
  EXPECT_THROW(CarCapture({.captures = {"packets.pcap"}, .finds_clock_offset = true},
                          find_vehicle("roof_vlp16")),
               UsageError);
}

}  // namespace
}  // namespace iog::tools
