// Hesai Pandar40P data packets (Pandar40P User Manual, "Point Cloud UDP Data"): ten blocks, each
// with a flag, and no header. Elevations are each unit's own: a description gives them.
#pragma once

#include <array>
#include <string_view>

#include "lidar/hesai.hpp"

namespace iog::lidar {

// Appendix "Absolute time of point cloud data": block 10 fires 28.58 us before the stamp, a block
// 55.56 us before the next; its lasers 3.62 to 54.67 us before that.
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
  // One turn is 180 packets of 400 points, with two returns 360.
  static constexpr DataSheet kDataSheet{
      .type = "hesai_pandar40p", .range_min_mm = 300, .max_points_per_scan = 370 * 400};
  static constexpr std::array<double, 0> kElevationsDeg{};
};

}  // namespace iog::lidar
