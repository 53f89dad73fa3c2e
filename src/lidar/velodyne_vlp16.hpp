// Decodes the data packets of the Velodyne VLP-16 (VLP-16 User Manual 63-9243, chapter 9). A block
// contains two firings of the 16 lasers, but only the azimuth of the first firing.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lidar/velodyne.hpp"
#include "lidar/velodyne_bytes.hpp"

namespace iog::lidar {

// A block takes 110.592 us. The first firing begins at the start of the block, and the second
// firing begins 55.296 us later (half the block). Within a firing, the lasers fire at intervals of
// 2.304 us (1/48 of the block).
consteval VelodyneUnit make_vlp16() {
  VelodyneUnit unit{.layers = 16,
                    .product = velodyne::kProductVlp16,
                    .old_product = velodyne::kProductHdl32e,
                    .range_unit_mm = 2,
                    .block_ns = 110'592,
                    .block_parts = 48};
  for (std::uint8_t channel = 0; channel < 32; ++channel) {
    unit.fires_at[channel] = static_cast<std::uint8_t>(channel % 16 + 24 * (channel / 16));
  }
  return unit;
}
inline constexpr VelodyneUnit kVlp16Unit = make_vlp16();

class VelodyneVlp16 : public VelodyneDecoder<kVlp16Unit> {
 public:
  static constexpr std::string_view kName = "Velodyne VLP-16";
  // The precision is 3 cm. One turn at 10 Hz in dual return mode consists of 151 packets.
  static constexpr DataSheet kDataSheet = data_sheet_of_velodyne("velodyne_vlp16", 160);
  // The elevation of each laser id, in wire order.
  static constexpr std::array<double, 16> kElevationsDeg{-15, 1, -13, 3,  -11, 5,  -9, 7,
                                                         -7,  9, -5,  11, -3,  13, -1, 15};
};

}  // namespace iog::lidar
