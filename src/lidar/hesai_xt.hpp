// Decodes the data packets of the Hesai PandarXT-16, PandarXT-32 and PandarXT-32M (PandarXT User
// Manual, "Point Cloud Data Packet"). XT models differ in how many lasers and blocks they have, and
// in the resolution of their ranges.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lidar/hesai.hpp"

namespace iog::lidar {

struct HesaiXtLayout {
  std::size_t blocks = 8;
  std::size_t lasers = 0;
  std::size_t lasers_at_once = 1;
  std::int64_t laser_ns = 0;
  std::uint32_t distance_unit_mm = 4;
};

// The manual's appendix "Absolute time of point cloud data" defines the firing times. The last
// block fires 5.632 us after the timestamp. Consecutive blocks fire 50 us apart. The first laser of
// a block fires 0.368 us after the block's firing time. Each of the other lasers fires laser_ns
// after the previous one.
consteval HesaiUnit make_hesai_xt(const HesaiXtLayout& layout) {
  HesaiUnit unit{.model = {0x06, 0x01},
                 .header_bytes = 12,
                 .counts_at = 6,
                 .distance_unit_at = 9,
                 .distance_unit_mm = layout.distance_unit_mm,
                 .blocks = layout.blocks,
                 .lasers = layout.lasers,
                 .channel_bytes = 4,
                 .stamped_block_ns = 5'632,
                 .first_laser_ns = 368,
                 .firing_ns = 50'000};
  const std::size_t tail = unit.block_at(unit.blocks);
  unit.mode_at = tail + 10;
  unit.utc_at = tail + 13;
  unit.time_at = tail + 19;
  unit.maker_at = tail + 23;
  unit.bytes = tail + 28;
  const auto steps = static_cast<std::int64_t>(layout.lasers / layout.lasers_at_once) - 1;
  unit.last_laser_ns = unit.first_laser_ns + steps * layout.laser_ns;
  return unit;
}
inline constexpr HesaiUnit kXt16Unit = make_hesai_xt({.lasers = 16, .laser_ns = 3'024});
inline constexpr HesaiUnit kXt32Unit = make_hesai_xt({.lasers = 32, .laser_ns = 1'512});
// Lasers k and k + 16 fire together. Triple return mode is not supported.
inline constexpr HesaiUnit kXt32mUnit = make_hesai_xt(
    {.blocks = 6, .lasers = 32, .lasers_at_once = 2, .laser_ns = 2'888, .distance_unit_mm = 5});

class HesaiXt16 : public HesaiDecoder<kXt16Unit> {
 public:
  static constexpr std::string_view kName = "Hesai PandarXT-16";
  // One turn consists of 250 packets of 128 points, or 500 packets in dual return mode.
  static constexpr DataSheet kDataSheet{
      .type = "hesai_xt16", .range_min_mm = 500, .max_points_per_scan = 512 * 128};
  // The elevation of each channel, in wire order.
  static constexpr std::array<double, 16> kElevationsDeg{15, 13, 11, 9,  7,  5,   3,   1,
                                                         -1, -3, -5, -7, -9, -11, -13, -15};
};

class HesaiXt32 : public HesaiDecoder<kXt32Unit> {
 public:
  static constexpr std::string_view kName = "Hesai PandarXT-32";
  // One turn consists of 250 packets of 256 points, or 500 packets in dual return mode.
  static constexpr DataSheet kDataSheet{
      .type = "hesai_xt32", .range_min_mm = 500, .max_points_per_scan = 512 * 256};
  // The elevation of each channel, in wire order.
  static constexpr std::array<double, 32> kElevationsDeg{
      15, 14, 13, 12, 11, 10, 9,  8,  7,  6,   5,   4,   3,   2,   1,   0,
      -1, -2, -3, -4, -5, -6, -7, -8, -9, -10, -11, -12, -13, -14, -15, -16};
};

// According to the data sheet, the field of view is 40.3 degrees high, its upper edge is 19.5
// degrees above the horizon, and the layers are 1.3 degrees apart.
consteval std::array<double, 32> elevations_of_xt32m() {
  std::array<double, 32> elevations{};
  for (std::size_t channel = 0; channel < elevations.size(); ++channel) {
    elevations[channel] = 19.5 - 1.3 * static_cast<double>(channel);
  }
  return elevations;
}

class HesaiXt32m : public HesaiDecoder<kXt32mUnit> {
 public:
  static constexpr std::string_view kName = "Hesai PandarXT-32M";
  // One turn consists of 334 packets of 192 points, or 667 packets in dual return mode.
  static constexpr DataSheet kDataSheet{
      .type = "hesai_xt32m", .range_min_mm = 500, .max_points_per_scan = 682 * 192};
  // The elevation of each channel, in wire order.
  static constexpr std::array<double, 32> kElevationsDeg = elevations_of_xt32m();
};

}  // namespace iog::lidar
