// Hesai PandarXT-16 and PandarXT-32 data packets (PandarXT User Manual, "Point Cloud Data Packet"),
// which differ in the number of lasers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lidar/hesai.hpp"

namespace iog::lidar {

// Appendix "Absolute time of point cloud data": block 8 fires 5.632 us after the stamp, a block
// 50 us before the next; its first laser 0.368 us after that, and each so long after the one
// before.
consteval HesaiUnit make_hesai_xt(std::size_t lasers, std::int64_t laser_ns) {
  HesaiUnit unit{.model = {0x06, 0x01},
                 .header_bytes = 12,
                 .counts_at = 6,
                 .distance_unit_at = 9,
                 .blocks = 8,
                 .lasers = lasers,
                 .channel_bytes = 4,
                 .last_block_ns = 5'632,
                 .first_laser_ns = 368,
                 .firing_ns = 50'000};
  const std::size_t tail = unit.block_at(unit.blocks);
  unit.mode_at = tail + 10;
  unit.utc_at = tail + 13;
  unit.time_at = tail + 19;
  unit.maker_at = tail + 23;
  unit.bytes = tail + 28;
  unit.last_laser_ns = unit.first_laser_ns + static_cast<std::int64_t>(lasers - 1) * laser_ns;
  return unit;
}
inline constexpr HesaiUnit kXt16Unit = make_hesai_xt(16, 3'024);
inline constexpr HesaiUnit kXt32Unit = make_hesai_xt(32, 1'512);

class HesaiXt16 : public HesaiDecoder<kXt16Unit> {
 public:
  static constexpr std::string_view kName = "Hesai PandarXT-16";
  // One turn is 250 packets of 128 points, with two returns 500.
  static constexpr DataSheet kDataSheet{
      .type = "hesai_xt16", .range_min_mm = 500, .max_points_per_scan = 512 * 128};
  // By channel, which is the order on the wire.
  static constexpr std::array<double, 16> kElevationsDeg{15, 13, 11, 9,  7,  5,   3,   1,
                                                         -1, -3, -5, -7, -9, -11, -13, -15};
};

class HesaiXt32 : public HesaiDecoder<kXt32Unit> {
 public:
  static constexpr std::string_view kName = "Hesai PandarXT-32";
  // One turn is 250 packets of 256 points, with two returns 500.
  static constexpr DataSheet kDataSheet{
      .type = "hesai_xt32", .range_min_mm = 500, .max_points_per_scan = 512 * 256};
  // By channel, which is the order on the wire.
  static constexpr std::array<double, 32> kElevationsDeg{
      15, 14, 13, 12, 11, 10, 9,  8,  7,  6,   5,   4,   3,   2,   1,   0,
      -1, -2, -3, -4, -5, -6, -7, -8, -9, -10, -11, -12, -13, -14, -15, -16};
};

}  // namespace iog::lidar
