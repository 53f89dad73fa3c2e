// Decodes the data packets of the Hesai Pandar40P (Pandar40P User Manual, "Point Cloud UDP Data").
// A packet has no header. Each of its ten blocks begins with a flag. The elevations differ between
// units, so the car file specifies them.
#pragma once

#include <array>
#include <string_view>

#include "lidar/hesai.hpp"

namespace iog::lidar {

// The manual's appendix "Absolute time of point cloud data" defines the firing times. Block 10
// fires 28.58 us before the timestamp. Consecutive blocks fire 55.56 us apart. The lasers of a
// block fire 3.62 to 54.67 us before the block's firing time.
inline constexpr HesaiUnit kPandar40pUnit{.flag_bytes = 2,
                                          .blocks = 10,
                                          .lasers = 40,
                                          .channel_bytes = 3,
                                          .mode_at = 1254,
                                          .utc_at = 1256,
                                          .time_at = 1250,
                                          .maker_at = 1255,
                                          .bytes = 1262,
                                          .may_follow_bytes = 4,
                                          .stamped_block_ns = -28'580,
                                          .first_laser_ns = -54'670,
                                          .last_laser_ns = -3'620,
                                          .firing_ns = 55'560};

class HesaiPandar40p : public HesaiDecoder<kPandar40pUnit> {
 public:
  static constexpr std::string_view kName = "Hesai Pandar40P";
  // One turn consists of 180 packets of 400 points, or 360 packets in dual return mode.
  static constexpr DataSheet kDataSheet{
      .type = "hesai_pandar40p", .range_min_mm = 300, .max_points_per_scan = 370 * 400};
  static constexpr std::array<double, 0> kElevationsDeg{};
};

}  // namespace iog::lidar
