#include "tools/simulate/scanners/lux_burst.hpp"

#include <array>
#include <utility>

#include "lidar/ibeo_lux.hpp"
#include "numeric/elementary.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/lux/ntp_time.hpp"

namespace iog::tools {
namespace {

constexpr std::uint16_t kScannerPort = 12'000;  // that they send from

// Motor on, laser on, frequency reached, and the compensations a healthy LUX reports.
constexpr std::uint16_t kHealthy = 0x030B;
constexpr std::uint16_t kGroundLabelled = 0x0001;
constexpr std::uint16_t kDirtDetected = 0x0002;
constexpr std::uint16_t kRainDetected = 0x0004;
constexpr std::uint16_t kRearSide = 0x0400;

// Yaw, pitch and roll in ticks, then x, y and z in centimetres.
std::array<std::int16_t, 6> mounting_of(const description::MountConfig& mount) {
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

void append_lux_scan(const description::SensorConfig& config, const LuxScanTime& time,
                     std::vector<LuxPoint> points, std::uint64_t first_sent_us,
                     std::vector<CapturedDatagram>& datagrams) {
  LuxScan scan;
  scan.device_id = static_cast<std::uint8_t>(time.sensor + 1);
  scan.sent_ntp = ntp_of_unix_us(time.end_us);
  scan.scan_number = static_cast<std::uint16_t>(time.number());
  scan.status = kHealthy;
  scan.start_ntp = ntp_of_unix_us(time.end_us - kLuxSweepUs);
  scan.end_ntp = ntp_of_unix_us(time.end_us);
  scan.mounting = mounting_of(config.mount);
  scan.points = std::move(points);
  scan.flags = kGroundLabelled | kDirtDetected | kRainDetected;
  if (config.format == lidar::kFormat<lidar::IbeoLux8> &&
      side_of_scan(time.number()) == MirrorSide::kRear) {
    scan.flags |= kRearSide;
  }
  std::vector<std::vector<std::byte>> messages = split_lux_scan(std::move(scan));
  std::uint64_t sent_us = first_sent_us;
  for (std::vector<std::byte>& message : messages) {
    datagrams.push_back({.time_us = sent_us,
                         .source = {config.source_ipv4, kScannerPort},
                         .destination = {kTargetIpv4, config.udp_port},
                         .payload = std::move(message)});
    sent_us += kLuxBurstGapUs;
  }
}

std::vector<CapturedDatagram> lux_burst(const CatalogueEntry& car, std::uint32_t frame,
                                        const ScanOfSensor& points_of) {
  const std::uint64_t scan_end_us = kDriveStartUs + (frame + 1) * kLuxPeriodUs;
  std::vector<CapturedDatagram> datagrams;
  for (std::size_t sensor = 0; sensor < car.sensors.size(); ++sensor) {
    append_lux_scan(car.sensors[sensor], {sensor, frame, scan_end_us}, points_of(sensor),
                    scan_end_us + datagrams.size() * kLuxBurstGapUs, datagrams);
  }
  return datagrams;
}

}  // namespace iog::tools
