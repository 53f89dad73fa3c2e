#include "tools/formats/lux/raw_recording.hpp"

#include <utility>

#include "lidar/velodyne.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/lux/lux_stream.hpp"
#include "tools/formats/lux/ntp_time.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/table.hpp"
#include "wire/byte_order.hpp"

namespace iog::tools {
namespace {

constexpr std::uint64_t kMessageGapUs = 70;  // between the messages of one scan
constexpr std::uint64_t kHourUs = 3'600'000'000U;
constexpr std::size_t kVelodyneTimeOffset = 1200;

CapturedDatagram datagram_of(const description::SensorConfig& sensor, std::uint64_t time_us,
                             std::vector<std::byte> payload) {
  const std::uint32_t source = sensor.source_ipv4 != 0 ? sensor.source_ipv4 : kUnnamedIpv4;
  return {.time_us = time_us,
          .source = {source, sensor.udp_port},
          .destination = {kTargetIpv4, sensor.udp_port},
          .payload = std::move(payload)};
}

RawRecording read_lux(const std::string& path, const description::SensorConfig& sensor) {
  LuxStream stream = read_lux_stream(read_file(path));
  if (stream.scans.empty()) {
    throw UsageError(path + ": no ibeo 0x2202 message in it");
  }
  RawRecording recording;
  for (LuxScan& scan : stream.scans) {
    std::uint64_t time_us = unix_us_of_ntp(scan.end_ntp);
    for (std::vector<std::byte>& message : split_lux_scan(std::move(scan))) {
      recording.datagrams.push_back(datagram_of(sensor, time_us, std::move(message)));
      time_us += kMessageGapUs;
    }
  }
  if (stream.other_messages + stream.malformed + stream.skipped_bytes > 0) {
    recording.remark = counted(stream.other_messages, "message|messages of other types, ") +
                       counted(stream.malformed, "malformed scan|scans, ") +
                       counted(stream.skipped_bytes, "byte|bytes that is|are no message");
  }
  return recording;
}

RawRecording read_velodyne(const std::string& path, const description::SensorConfig& sensor) {
  constexpr std::size_t kBytes = lidar::VelodynePacket::kPacketBytes;
  const std::vector<std::byte> bytes = read_file(path);
  if (bytes.empty() || bytes.size() % kBytes != 0) {
    throw UsageError(path + ": not a number of Velodyne payloads of 1206 bytes");
  }
  RawRecording recording;
  std::uint64_t hour_us = kDriveStartUs;
  std::uint64_t last_us = 0;
  for (auto rest = std::span<const std::byte>(bytes); !rest.empty(); rest = rest.subspan(kBytes)) {
    const auto payload = rest.first<kBytes>();
    const std::uint64_t in_hour_us = wire::load_le32(payload.subspan<kVelodyneTimeOffset, 4>());
    // The next hour has begun, unless two payloads are merely out of order.
    if (in_hour_us + kHourUs / 2 < last_us) {
      hour_us += kHourUs;
    }
    last_us = in_hour_us;
    recording.datagrams.push_back(
        datagram_of(sensor, hour_us + in_hour_us, {payload.begin(), payload.end()}));
  }
  return recording;
}

}  // namespace

RawRecording read_raw_recording(const std::string& path, const CatalogueEntry& car,
                                std::size_t sensor) {
  const description::SensorConfig& config = car.sensors[sensor];
  return sends_lux_scans(config.format) ? read_lux(path, config) : read_velodyne(path, config);
}

}  // namespace iog::tools
