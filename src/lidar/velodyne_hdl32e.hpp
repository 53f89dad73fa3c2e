// Decodes the data packets of the Velodyne HDL-32E (HDL-32E User Manual 63-9113). A block contains
// one firing of all 32 lasers.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "lidar/velodyne.hpp"
#include "lidar/velodyne_bytes.hpp"

namespace iog::lidar {

// A block takes 46.08 us. The first channel fires at the start of the block, and the other channels
// follow at intervals of 1.152 us (1/40 of the block). The unit pauses after the 32nd channel.
consteval VelodyneUnit make_hdl32e() {
  VelodyneUnit unit{.layers = 32,
                    .product = velodyne::kProductHdl32e,
                    .old_product = velodyne::kProductHdl32e,
                    .range_unit_mm = 2,
                    .block_ns = 46'080,
                    .block_parts = 40};
  for (std::uint8_t channel = 0; channel < 32; ++channel) {
    unit.fires_at[channel] = channel;
  }
  return unit;
}
inline constexpr VelodyneUnit kHdl32eUnit = make_hdl32e();

// The elevations of even channels range from -30.67 to -10.67 degrees, and those of odd channels
// range from -9.33 to 10.67 degrees. In both cases, the step is 4/3 degrees.
consteval std::array<double, 32> make_hdl32e_elevations() {
  std::array<double, 32> elevations{};
  for (std::size_t channel = 0; channel < 32; ++channel) {
    const std::size_t pair = channel / 2;
    const double lowest = channel % 2 == 0 ? -92.0 / 3 : -28.0 / 3;
    elevations[channel] = lowest + static_cast<double>(pair) * 4 / 3;
  }
  return elevations;
}

class VelodyneHdl32e : public VelodyneDecoder<kHdl32eUnit> {
 public:
  static constexpr std::string_view kName = "Velodyne HDL-32E";
  // The data sheet specifies a precision of 2 cm, but iogrid uses 3 cm. One turn at 10 Hz consists
  // of 181 packets, or 362 packets in dual return mode.
  static constexpr DataSheet kDataSheet = data_sheet_of_velodyne("velodyne_hdl32e", 370);
  // The elevation of each channel, in wire order.
  static constexpr std::array<double, 32> kElevationsDeg = make_hdl32e_elevations();
};

}  // namespace iog::lidar
