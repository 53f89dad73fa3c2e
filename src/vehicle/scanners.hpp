// The scanners that vehicle descriptions are made of, with the limits of their data sheets. A
// description that needs another value changes that one member of what it gets here.
#pragma once

#include <cstdint>
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

// A Velodyne VLP-16 (User Manual 63-9243): precise to 3 cm. It sees 100 m; the grid ends 51 m away
// and 72 m in its corners, and nothing beyond can be seen on it. One turn at 10 Hz in dual return
// mode is 151 packets.
constexpr SensorConfig velodyne_vlp16(std::string_view name, std::uint32_t source_ipv4,
                                      std::uint16_t udp_port, const MountConfig& mount) {
  return {.name = name,
          .format = lidar::Format::kVelodyneVlp16,
          .source_ipv4 = source_ipv4,
          .udp_port = udp_port,
          .mount = mount,
          .range_min_mm = 1'000,
          .range_max_mm = 73'000,
          .precision_mm = 30,
          .sigma_m = 0.03,
          .scan_width_ticks = 36'000,
          .max_points_per_scan = 160 * 384};
}

}  // namespace iog::vehicle
