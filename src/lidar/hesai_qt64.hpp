// Decodes the data packets of the Hesai PandarQT-64 (PandarQT User Manual, "Point Cloud Data
// Packet"). The lasers point up to 52 degrees up or down and up to 9 degrees to either side. The
// angles differ between units, so the car file contains the angles from the manufacturer's
// calibration file.
#pragma once

#include <array>
#include <string_view>

#include "lidar/hesai.hpp"

namespace iog::lidar {

// The manual's appendix "Absolute time of point cloud data" defines the firing times. Block 1 fires
// 25.71 us after the timestamp. Consecutive blocks fire 166.67 us apart. The lasers of a block fire
// 12.31 to 146.45 us after the block's firing time. In HesaiLidar_SDK_2.0, these times are 2.31 to
// 136.45 us.
inline constexpr HesaiUnit kQt64Unit{.model = {0x03, 0x01},
                                     .flags = 0x01,
                                     .header_bytes = 12,
                                     .counts_at = 6,
                                     .distance_unit_at = 9,
                                     .blocks = 4,
                                     .lasers = 64,
                                     .channel_bytes = 4,
                                     .mode_at = 1060,
                                     .utc_at = 1062,
                                     .time_at = 1056,
                                     .maker_at = 1061,
                                     .bytes = 1068,
                                     .may_follow_bytes = 4,
                                     .is_first_stamped = true,
                                     .stamped_block_ns = 25'710,
                                     .first_laser_ns = 12'310,
                                     .last_laser_ns = 146'450,
                                     .firing_ns = 166'667};

class HesaiQt64 : public HesaiDecoder<kQt64Unit> {
 public:
  static constexpr std::string_view kName = "Hesai PandarQT-64";
  // One turn consists of 150 packets of 256 points, or 300 packets in dual return mode.
  static constexpr DataSheet kDataSheet{
      .type = "hesai_qt64", .range_min_mm = 100, .max_points_per_scan = 310 * 256};
  static constexpr std::array<double, 0> kElevationsDeg{};
};

}  // namespace iog::lidar
