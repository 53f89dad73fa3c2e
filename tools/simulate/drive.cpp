#include "tools/simulate/drive.hpp"

#include <string>
#include <utility>

#include "tools/command/exit_status.hpp"
#include "tools/lux/ntp_time.hpp"

namespace iog::tools {
namespace {

// 2024-05-01 12:00:00 UTC: every drive begins then, so that its bytes do not depend on the day.
constexpr std::uint64_t kStartUs = 1'714'564'800'000'000U;
constexpr std::uint64_t kFramePeriodUs = kMicrosecondsPerSecond / Drive::kFramesPerSecond;
constexpr std::uint64_t kSweepUs = 11'111;  // 100 degrees at 25 Hz
// Twenty to thirty datagrams of four scanners within two milliseconds.
constexpr std::uint64_t kBurstGapUs = 70;

constexpr Endpoint kTarget{.ipv4 = 0x0A00020F, .port = 0};  // 10.0.2.15
constexpr std::uint16_t kScannerPort = 12'000;              // that they send from

// Motor on, laser on, frequency reached, and the compensations a healthy LUX reports.
constexpr std::uint16_t kHealthy = 0x030B;
constexpr std::uint16_t kGroundLabelled = 0x0001;
constexpr std::uint16_t kDirtDetected = 0x0002;
constexpr std::uint16_t kRainDetected = 0x0004;

std::uint64_t stream_of(std::uint32_t frame, std::size_t sensor) {
  constexpr std::uint64_t kNoiseStreams = 1000;  // the world's own streams are below
  return kNoiseStreams + std::uint64_t{frame} * vehicle::kMaxSensors + sensor;
}

}  // namespace

Drive::Drive(const CatalogueEntry& car, std::uint64_t seed, std::uint32_t seconds,
             const SceneEntry& scene)
    : car_(&car),
      seed_(seed),
      frame_count_(seconds * kFramesPerSecond),
      scene_(scene.make(seed, seconds)) {
  for (const vehicle::SensorConfig& sensor : car.sensors) {
    if (sensor.format != lidar::Format::kIbeoLux) {
      throw UsageError("only ibeo LUX scanners are simulated, and " +
                       std::string(car.vehicle->name) + " has a VLP-16; use a recording for it");
    }
    scanners_.emplace_back(sensor);
  }
}

void Drive::move_to(std::uint32_t frame) {
  frame_ = frame;
  scan_end_us_ = kStartUs + (frame + 1) * kFramePeriodUs;
  const double time_s = static_cast<double>(frame) / kFramesPerSecond;
  ego_ = scene_.ego_at(time_s);
  solids_.clear();
  scene_.append_seen_at(time_s, solids_);
}

LuxScan Drive::scan_of(std::size_t sensor) {
  Random random(seed_, stream_of(frame_, sensor));
  LuxScan scan;
  scan.device_id = static_cast<std::uint8_t>(sensor + 1);
  scan.sent_ntp = ntp_of_unix_us(scan_end_us_);
  scan.scan_number = static_cast<std::uint16_t>(frame_ + 1);
  scan.status = kHealthy;
  scan.start_ntp = ntp_of_unix_us(scan_end_us_ - kSweepUs);
  scan.end_ntp = ntp_of_unix_us(scan_end_us_);
  scan.mounting = scanners_[sensor].mounting();
  scan.points = scanners_[sensor].scan(ego_, solids_, random);
  scan.flags = kGroundLabelled | kDirtDetected | kRainDetected;
  return scan;
}

std::vector<CapturedDatagram> Drive::datagrams() {
  std::vector<CapturedDatagram> datagrams;
  for (std::size_t sensor = 0; sensor < scanners_.size(); ++sensor) {
    const vehicle::SensorConfig& config = car_->sensors[sensor];
    for (std::vector<std::byte>& message : split_lux_scan(scan_of(sensor))) {
      datagrams.push_back({.time_us = scan_end_us_ + datagrams.size() * kBurstGapUs,
                           .source = {config.source_ipv4, kScannerPort},
                           .destination = {kTarget.ipv4, config.udp_port},
                           .payload = std::move(message)});
    }
  }
  return datagrams;
}

}  // namespace iog::tools
