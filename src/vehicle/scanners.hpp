// The scanners that vehicle descriptions are made of, with the limits of their data sheets. A
// description that needs another value changes that one member of what it gets here.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

#include "vehicle/description.hpp"

namespace iog::vehicle {

// An ibeo LUX as docs/model.md section 8 uses it (thesis section 4.1.4): 100 degrees, precise to 10
// cm, up to 50 m. azimuths: directions in a layer, of which each can have three echoes.
constexpr SensorConfig ibeo_lux(std::string_view name, std::uint32_t source_ipv4,
                                std::uint16_t udp_port, const MountConfig& mount,
                                std::uint32_t azimuths) {
  return {.name = name,
          .format = lidar::Format::kIbeoLux,
          .source_ipv4 = source_ipv4,
          .udp_port = udp_port,
          .mount = mount,
          .range_min_mm = 300,
          .range_max_mm = 50'000,
          .precision_mm = 100,
          .sigma_m = 0.10,
          .scan_width_ticks = 3200,
          .max_points_per_scan = 4 * azimuths * 3};
}

// An ibeo LUX or a SICK LD-MRS with eight layers. A frame is a scan of one side of its mirror,
// which has four layers of them. beam_tilt_deg: of the unit, which tells it as its parameter
// 0x3302.
constexpr SensorConfig ibeo_lux_8l(std::string_view name, std::uint32_t source_ipv4,
                                   std::uint16_t udp_port, const MountConfig& mount,
                                   std::uint32_t azimuths, double beam_tilt_deg) {
  SensorConfig config = ibeo_lux(name, source_ipv4, udp_port, mount, azimuths);
  config.format = lidar::Format::kIbeoLux8;
  config.beam_tilt_deg = beam_tilt_deg;
  return config;
}

// The same scanner, whose clock is that of the poses.
constexpr SensorConfig synchronised(SensorConfig config) {
  config.is_synchronised = true;
  return config;
}

// What lidars that turn have in common here: precise to 3 cm. They see 70 m or more; the grid ends
// 51 m away and 72 m in its corners, and nothing beyond can be seen on it. points: of one turn,
// some more than it can have. lasers: as the unit's calibration has them, or none.
constexpr SensorConfig turning(lidar::Format format, std::string_view name,
                               std::uint32_t source_ipv4, std::uint16_t udp_port,
                               const MountConfig& mount, std::uint32_t range_min_mm,
                               std::uint32_t points, std::span<const lidar::Laser> lasers = {}) {
  return {.name = name,
          .format = format,
          .source_ipv4 = source_ipv4,
          .udp_port = udp_port,
          .mount = mount,
          .range_min_mm = range_min_mm,
          .range_max_mm = 73'000,
          .precision_mm = 30,
          .sigma_m = 0.03,
          .scan_width_ticks = 36'000,
          .max_points_per_scan = points,
          .lasers = lasers};
}

// A Hesai Pandar64 (User Manual): one turn with one return is 300 packets of 384 points; with two
// returns it is more than a frame can mark.
constexpr SensorConfig hesai_pandar64(std::string_view name, std::uint32_t source_ipv4,
                                      std::uint16_t udp_port, const MountConfig& mount,
                                      std::span<const lidar::Laser> lasers) {
  return turning(lidar::Format::kHesaiPandar64, name, source_ipv4, udp_port, mount, 500, 320 * 384,
                 lasers);
}

// A Hesai PandarXT-32 (User Manual): one turn is 250 packets of 256 points, with two returns 500.
constexpr SensorConfig hesai_xt32(std::string_view name, std::uint32_t source_ipv4,
                                  std::uint16_t udp_port, const MountConfig& mount,
                                  std::span<const lidar::Laser> lasers = {}) {
  return turning(lidar::Format::kHesaiXt32, name, source_ipv4, udp_port, mount, 500, 512 * 256,
                 lasers);
}

// An Ouster OS (Hardware User Manual): it sees from 0.3 m. lasers: by row from the top, as the
// unit's metadata has them. mode: what it is set to.
constexpr SensorConfig ouster(lidar::Format profile, std::string_view name,
                              std::uint32_t source_ipv4, std::uint16_t udp_port,
                              const MountConfig& mount, std::span<const lidar::Laser> lasers,
                              const lidar::TurnMode& mode) {
  const std::uint32_t points = mode.columns_per_turn * static_cast<std::uint32_t>(lasers.size());
  SensorConfig config = turning(profile, name, source_ipv4, udp_port, mount, 300, points, lasers);
  config.scan_width_ticks = 46'080;
  config.mode = mode;
  return config;
}

// packets: of one turn.
constexpr SensorConfig velodyne(lidar::Format format, std::string_view name,
                                std::uint32_t source_ipv4, std::uint16_t udp_port,
                                const MountConfig& mount, std::uint32_t packets,
                                std::span<const lidar::Laser> lasers = {}) {
  return turning(format, name, source_ipv4, udp_port, mount, 1'000, packets * 384, lasers);
}

// A Velodyne HDL-32E (User Manual 63-9113): precise to 2 cm, taken as 3. One turn at 10 Hz is 181
// packets, in dual return mode 362.
constexpr SensorConfig velodyne_hdl32e(std::string_view name, std::uint32_t source_ipv4,
                                       std::uint16_t udp_port, const MountConfig& mount) {
  return velodyne(lidar::Format::kVelodyneHdl32e, name, source_ipv4, udp_port, mount, 370);
}

// A Velodyne HDL-64E (manuals 63-HDL64ES2 and 63-HDL64ES3): precise to 2 cm, taken as 3. One turn
// at 10 Hz is 348 packets of an S2 and 290 of an S3; in dual return mode an S3 sends 579, more than
// a frame can mark. lasers: all 64, as the unit's calibration has them.
constexpr SensorConfig velodyne_hdl64e(lidar::Format format, std::string_view name,
                                       std::uint32_t source_ipv4, std::uint16_t udp_port,
                                       const MountConfig& mount,
                                       std::span<const lidar::Laser> lasers) {
  const std::uint32_t packets = format == lidar::Format::kVelodyneHdl64eS2 ? 360 : 300;
  return velodyne(format, name, source_ipv4, udp_port, mount, packets, lasers);
}

// A Velodyne VLP-16 (User Manual 63-9243): precise to 3 cm. One turn at 10 Hz in dual return mode
// is 151 packets.
constexpr SensorConfig velodyne_vlp16(std::string_view name, std::uint32_t source_ipv4,
                                      std::uint16_t udp_port, const MountConfig& mount) {
  return velodyne(lidar::Format::kVelodyneVlp16, name, source_ipv4, udp_port, mount, 160);
}

// A Velodyne VLP-32C (User Manual 63-9325): precise to 3 cm. One turn at 10 Hz in dual return mode
// is 302 packets.
constexpr SensorConfig velodyne_vlp32c(std::string_view name, std::uint32_t source_ipv4,
                                       std::uint16_t udp_port, const MountConfig& mount) {
  return velodyne(lidar::Format::kVelodyneVlp32c, name, source_ipv4, udp_port, mount, 310);
}

// By the names that a car's file gives them as `type`.
struct ScannerType {
  std::string_view name;
  SensorConfig config;  // without name, port and mount, which are those of the car
};

// How many points a scan of a LUX has at most depends on its angular resolution, of an Ouster on
// its rows and mode: a description says it.
inline constexpr std::array kScannerTypes{
    ScannerType{"hesai_pandar64", hesai_pandar64("", 0, 0, {}, {})},
    ScannerType{"hesai_xt32", hesai_xt32("", 0, 0, {})},
    ScannerType{"ibeo_lux", ibeo_lux("", 0, 0, {}, 0)},
    ScannerType{"ibeo_lux_8l", ibeo_lux_8l("", 0, 0, {}, 0, 0)},
    ScannerType{"ouster_legacy", ouster(lidar::Format::kOusterLegacy, "", 0, 0, {}, {}, {})},
    ScannerType{"ouster_rng15", ouster(lidar::Format::kOusterRng15, "", 0, 0, {}, {}, {})},
    ScannerType{"ouster_rng19", ouster(lidar::Format::kOusterRng19, "", 0, 0, {}, {}, {})},
    ScannerType{"sick_ld_mrs_8l", ibeo_lux_8l("", 0, 0, {}, 0, 0)},
    ScannerType{"velodyne_hdl32e", velodyne_hdl32e("", 0, 0, {})},
    ScannerType{"velodyne_hdl64e_s2",
                velodyne_hdl64e(lidar::Format::kVelodyneHdl64eS2, "", 0, 0, {}, {})},
    ScannerType{"velodyne_hdl64e_s3",
                velodyne_hdl64e(lidar::Format::kVelodyneHdl64eS3, "", 0, 0, {}, {})},
    ScannerType{"velodyne_vlp16", velodyne_vlp16("", 0, 0, {})},
    ScannerType{"velodyne_vlp32c", velodyne_vlp32c("", 0, 0, {})},
};

}  // namespace iog::vehicle
