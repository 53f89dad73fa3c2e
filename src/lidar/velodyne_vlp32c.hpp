// Decodes the data packets of the Velodyne VLP-32C (VLP-32C User Manual 63-9325, chapter 9). A
// block contains one firing of all 32 lasers. The lasers fire in pairs, slightly to the left or
// right of the block's azimuth. The unit of range is 4 mm.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lidar/velodyne.hpp"
#include "lidar/velodyne_bytes.hpp"

namespace iog::lidar {

// A block takes 55.296 us. The first two channels fire at the start of the block, and the other
// pairs of channels follow at intervals of 2.304 us (1/24 of the block).
consteval VelodyneUnit make_vlp32c() {
  VelodyneUnit unit{.layers = 32,
                    .product = velodyne::kProductVlp32c,
                    .old_product = velodyne::kProductVlp32c,
                    .range_unit_mm = 4,
                    .block_ns = 55'296,
                    .block_parts = 24,
                    .azimuth_offsets = {140, -420, 140, -140, 140, -140, 420, -140,  //
                                        140, -420, 140, -140, 420, -140, 420, -140,  //
                                        140, -420, 140, -420, 420, -140, 140, -140,  //
                                        140, -140, 140, -420, 420, -140, 140, -140}};
  for (std::uint8_t channel = 0; channel < 32; ++channel) {
    unit.fires_at[channel] = channel / 2;
  }
  return unit;
}
inline constexpr VelodyneUnit kVlp32cUnit = make_vlp32c();

class VelodyneVlp32c : public VelodyneDecoder<kVlp32cUnit> {
 public:
  static constexpr std::string_view kName = "Velodyne VLP-32C";
  // The precision is 3 cm. One turn at 10 Hz in dual return mode consists of 302 packets.
  static constexpr DataSheet kDataSheet = data_sheet_of_velodyne("velodyne_vlp32c", 310);
  // The elevation of each channel, in wire order.
  static constexpr std::array<double, 32> kElevationsDeg{
      -25,    -1,    -1.667, -15.639, -11.31, 0,     -0.667, -8.843,  //
      -7.254, 0.333, -0.333, -6.148,  -5.333, 1.333, 0.667,  -4,      //
      -4.667, 1.667, 1,      -3.667,  -3.333, 3.333, 2.333,  -2.667,  //
      -3,     7,     4.667,  -2.333,  -2,     15,    10.333, -1.333};
};

}  // namespace iog::lidar
