// Decodes the data packets of the Hesai QT128, also called QT128C2X (QT128C2X User Manual, "Point
// Cloud Data Packet"). The lasers point up to 53 degrees up or down and up to 11 degrees to either
// side. The angles differ between units, so the car file contains the angles from the
// manufacturer's calibration file.
#pragma once

#include <array>
#include <string_view>

#include "lidar/hesai.hpp"

namespace iog::lidar {

// Each firing uses 96 lasers. Firings alternate between two sets of lasers: lasers 33 to 128, and
// lasers 1 to 32 plus 65 to 128. The points from the 32 unused lasers have no range. In dual return
// mode, a packet contains one firing. The decoder does not verify checksums, and it cannot verify
// the 32-byte signature. The manual's appendix "Absolute time of point cloud data" defines the
// firing times. Block 1 fires 9 us after the timestamp. Consecutive blocks fire 111.11 us apart.
// The lasers of a block fire 0.6 to 100.52 us after the block's firing time. According to
// tier4/nebula, block 2 fires first.
inline constexpr HesaiUnit kQt128Unit{.model = {0x03, 0x02},
                                      .flags = 0x1D,
                                      .header_bytes = 12,
                                      .counts_at = 6,
                                      .distance_unit_at = 9,
                                      .blocks = 2,
                                      .lasers = 128,
                                      .bank_lasers = 32,
                                      .channel_bytes = 4,
                                      .bank_at = 1066,
                                      .speed_at = 1074,
                                      .mode_at = 1073,
                                      .utc_at = 1076,
                                      .time_at = 1082,
                                      .maker_at = 1086,
                                      .bytes = 1095,
                                      .may_follow_bytes = 32,
                                      .is_first_stamped = true,
                                      .stamped_block_ns = 9'000,
                                      .first_laser_ns = 600,
                                      .last_laser_ns = 100'520,
                                      .firing_ns = 111'111};

class HesaiQt128 : public HesaiDecoder<kQt128Unit> {
 public:
  static constexpr std::string_view kName = "Hesai QT128";
  // In single return mode, one turn consists of 450 packets of 256 points. In each packet, 64
  // points are from lasers that did not fire. In dual return mode, one turn has more points than
  // the default of max_points_per_scan (docs/sensors.md).
  static constexpr DataSheet kDataSheet{
      .type = "hesai_qt128", .range_min_mm = 50, .max_points_per_scan = 470 * 256};
  static constexpr std::array<double, 0> kElevationsDeg{};
};

}  // namespace iog::lidar
