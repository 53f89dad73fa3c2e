// Decodes the data packets of the Velodyne VLS-128 (Alpha Prime; VLS-128 User Manual 63-9483,
// chapter 9). Four blocks with the same azimuth contain a firing of all 128 lasers. Each block
// contains the ranges of a bank of 32 lasers, and its flag identifies the bank. The banks fire one
// after another. Within a bank, eight lasers fire at a time, each to the left or right of the
// block's azimuth. The unit of range is 4 mm. Dual return mode is not supported, because no
// recording of this mode is available.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "lidar/velodyne.hpp"
#include "lidar/velodyne_bytes.hpp"

namespace iog::lidar {

// According to chapter 9.4, a firing consists of 20 slots. Each group of eight lasers fires in its
// own slot. Groups 0 to 7 use the first eight slots. After a pause of one slot, groups 8 to 15 use
// the next eight slots. The manual specifies 53.3 us per firing. In a recording, the three firings
// of a packet take 165.84 us.
consteval VelodyneUnit make_vls128() {
  VelodyneUnit unit{.layers = 128,
                    .banks = 4,
                    .product = velodyne::kProductVls128,
                    .old_product = velodyne::kProductVls128ByManual,
                    .range_unit_mm = 4,
                    .has_two_returns = false,
                    .block_ns = 55'280,
                    .block_parts = 20,
                    .bank_fires_at = {0, 4, 9, 13}};
  constexpr std::array<std::int16_t, 8> kOffsets{635, 455, 273, 91, -91, -273, -455, -635};
  for (std::uint8_t channel = 0; channel < 32; ++channel) {
    unit.fires_at[channel] = channel / 8;
    unit.azimuth_offsets[channel] = kOffsets[channel % 8];
  }
  return unit;
}
inline constexpr VelodyneUnit kVls128Unit = make_vls128();

class VelodyneVls128 : public VelodyneDecoder<kVls128Unit> {
 public:
  static constexpr std::string_view kName = "Velodyne VLS-128";
  // The precision is 3 cm. One turn at 10 Hz consists of 603 packets.
  static constexpr DataSheet kDataSheet = data_sheet_of_velodyne("velodyne_vls128", 620);
  // The elevation of each laser id, sorted by bank and then by channel.
  static constexpr std::array<double, 128> kElevationsDeg{
      -11.742, -1.99,   3.4,    -5.29,  -0.78, 4.61,    -4.08,   1.31,     //
      -6.5,    -1.11,   4.28,   -4.41,  0.1,   6.48,    -3.2,    2.19,     //
      -3.86,   1.53,    -9.244, -1.77,  2.74,  -5.95,   -0.56,   4.83,     //
      -2.98,   2.41,    -6.28,  -0.89,  3.62,  -5.07,   0.32,    7.58,     //
      -0.34,   5.18,    -3.64,  1.75,   -25,   -2.43,   2.96,    -5.73,    //
      0.54,    9.7,     -2.76,  2.63,   -7.65, -1.55,   3.84,    -4.85,    //
      3.18,    -5.51,   -0.12,  5.73,   -4.3,  1.09,    -16.042, -2.21,    //
      4.06,    -4.63,   0.76,   15,     -3.42, 1.97,    -6.85,   -1.33,    //
      -5.62,   -0.23,   5.43,   -3.53,  0.98,  -19.582, -2.32,   3.07,     //
      -4.74,   0.65,    11.75,  -2.65,  1.86,  -7.15,   -1.44,   3.95,     //
      -2.1,    3.29,    -5.4,   -0.01,  4.5,   -4.19,   1.2,     -13.565,  //
      -1.22,   4.17,    -4.52,  0.87,   6.08,  -3.31,   2.08,    -6.65,    //
      1.42,    -10.346, -1.88,  3.51,   -6.06, -0.67,   4.72,    -3.97,    //
      2.3,     -6.39,   -1,     4.39,   -5.18, 0.21,    6.98,    -3.09,    //
      4.98,    -3.75,   1.64,   -8.352, -2.54, 2.85,    -5.84,   -0.45,    //
      8.43,    -2.87,   2.52,   -6.17,  -1.66, 3.73,    -4.96,   0.43};
};

}  // namespace iog::lidar
