#include "tools/poses/standing_car.hpp"

#include <algorithm>
#include <optional>

#include "tools/formats/capture/pcap_reader.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/poses/pose_encoder.hpp"
#include "tools/program/exit_status.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kEveryUs = 50'000;
constexpr std::uint64_t kLongestPauseUs = 1'000'000;  // nothing is placed in a longer one

// Springs and the floor move it by less.
constexpr double kSigmaM = 0.01;
constexpr double kSigmaRad = 1e-4;

}  // namespace

std::uint64_t write_with_standing_poses(const std::string& capture, std::uint16_t pose_port,
                                        const std::string& out) {
  PcapReader reader(capture);
  PcapWriter writer(out);
  PoseEncoder encoder;
  std::uint64_t poses = 0;
  std::uint64_t due_us = 0;
  while (const std::optional<CapturedDatagram> datagram = reader.next()) {
    const std::uint64_t now_us = datagram->time_us;
    if (datagram->destination.port == pose_port) {
      throw UsageError(capture + ": it has datagrams to UDP port " + std::to_string(pose_port) +
                       ", the port of the poses");
    }
    due_us = std::max(due_us, now_us - std::min(now_us, kLongestPauseUs));
    for (; due_us <= now_us; due_us += kEveryUs) {
      CapturedDatagram pose = encoder.datagram_of(
          {.time_us = due_us, .sigma_m = kSigmaM, .sigma_heading_rad = kSigmaRad});
      pose.destination.port = pose_port;
      writer.write(pose);
      ++poses;
    }
    writer.write(*datagram);
  }
  if (poses == 0) {
    throw UsageError(capture + ": no datagram in it");
  }
  writer.finish();
  warn_of(capture, reader);
  return poses;
}

}  // namespace iog::tools
