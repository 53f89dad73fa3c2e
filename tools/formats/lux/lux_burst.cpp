#include "tools/formats/lux/lux_burst.hpp"

#include <array>
#include <utility>

#include "lidar/ibeo_lux.hpp"
#include "numeric/elementary.hpp"
#include "tools/formats/lux/ntp_time.hpp"

namespace iog::tools {
namespace {

// 2024-05-01 12:00:00 UTC: every drive begins then, so that its bytes do not depend on the day.
constexpr std::uint64_t kStartUs = 1'714'564'800'000'000U;
constexpr std::uint64_t kFramePeriodUs = kMicrosecondsPerSecond / kLuxFramesPerSecond;
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

// Yaw, pitch and roll in ticks, then x, y and z in centimetres.
std::array<std::int16_t, 6> mounting_of(const vehicle::MountConfig& mount) {
  const auto ticks = [](double degrees) {
    return static_cast<std::int16_t>(
        numeric::round(degrees * lidar::IbeoLux::kTicksPerTurn / 360.0));
  };
  const auto centimetres = [](double metres) {
    return static_cast<std::int16_t>(numeric::round(metres * 100));
  };
  return {ticks(mount.yaw_deg),   ticks(mount.pitch_deg), ticks(mount.roll_deg),
          centimetres(mount.x_m), centimetres(mount.y_m), centimetres(mount.z_m)};
}

}  // namespace

std::vector<CapturedDatagram> lux_burst(const CatalogueEntry& car, std::uint32_t frame,
                                        const ScanOfSensor& points_of) {
  const std::uint64_t scan_end_us = kStartUs + (frame + 1) * kFramePeriodUs;
  std::vector<CapturedDatagram> datagrams;
  for (std::size_t sensor = 0; sensor < car.sensors.size(); ++sensor) {
    const vehicle::SensorConfig& config = car.sensors[sensor];
    LuxScan scan;
    scan.device_id = static_cast<std::uint8_t>(sensor + 1);
    scan.sent_ntp = ntp_of_unix_us(scan_end_us);
    scan.scan_number = static_cast<std::uint16_t>(frame + 1);
    scan.status = kHealthy;
    scan.start_ntp = ntp_of_unix_us(scan_end_us - kSweepUs);
    scan.end_ntp = ntp_of_unix_us(scan_end_us);
    scan.mounting = mounting_of(config.mount);
    scan.points = points_of(sensor);
    scan.flags = kGroundLabelled | kDirtDetected | kRainDetected;
    std::vector<std::vector<std::byte>> messages = split_lux_scan(std::move(scan));
    for (std::vector<std::byte>& message : messages) {
      datagrams.push_back({.time_us = scan_end_us + datagrams.size() * kBurstGapUs,
                           .source = {config.source_ipv4, kScannerPort},
                           .destination = {kTarget.ipv4, config.udp_port},
                           .payload = std::move(message)});
    }
  }
  return datagrams;
}

}  // namespace iog::tools
