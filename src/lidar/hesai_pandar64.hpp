// Decodes the data packets of the Hesai Pandar64 (Pandar64 User Manual, "Point Cloud Data Packet").
// The elevations differ between units, so the car file specifies them.
#pragma once

#include <array>
#include <string_view>

#include "lidar/hesai.hpp"

namespace iog::lidar {

// The manual's appendix "Absolute time of point cloud data" defines the firing times. Block 6 fires
// 42.58 us before the timestamp. Consecutive blocks fire 55.56 us apart. The lasers of a block fire
// 3.62 to 54.67 us before the block's firing time.
inline constexpr HesaiUnit kPandar64Unit{.model = {0x40, 0x06},
                                         .header_bytes = 8,
                                         .counts_at = 2,
                                         .distance_unit_at = 5,
                                         .blocks = 6,
                                         .lasers = 64,
                                         .channel_bytes = 3,
                                         .mode_at = 1186,
                                         .utc_at = 1188,
                                         .time_at = 1182,
                                         .maker_at = 1187,
                                         .bytes = 1194,
                                         .may_follow_bytes = 4,
                                         .stamped_block_ns = -42'580,
                                         .first_laser_ns = -54'670,
                                         .last_laser_ns = -3'620,
                                         .firing_ns = 55'560};

class HesaiPandar64 : public HesaiDecoder<kPandar64Unit> {
 public:
  static constexpr std::string_view kName = "Hesai Pandar64";
  // In single return mode, one turn consists of 300 packets of 384 points. In dual return mode, one
  // turn has more points than the default of max_points_per_scan (docs/sensors.md).
  static constexpr DataSheet kDataSheet{
      .type = "hesai_pandar64", .range_min_mm = 500, .max_points_per_scan = 320 * 384};
  static constexpr std::array<double, 0> kElevationsDeg{};
};

}  // namespace iog::lidar
