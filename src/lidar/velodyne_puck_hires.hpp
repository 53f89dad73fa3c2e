// Decodes the data packets of the Velodyne Puck Hi-Res (VLP-16 User Manual 63-9243, chapter 9 and
// appendix on the Puck Hi-Res). The packets have the same format as VLP-16 packets, but the lasers
// are 1.33 degrees apart.
#pragma once

#include <array>
#include <string_view>

#include "lidar/velodyne.hpp"
#include "lidar/velodyne_bytes.hpp"
#include "lidar/velodyne_vlp16.hpp"

namespace iog::lidar {

consteval VelodyneUnit make_puck_hires() {
  VelodyneUnit unit = kVlp16Unit;
  unit.product = velodyne::kProductPuckHires;
  unit.old_product = velodyne::kProductPuckHires;
  return unit;
}
inline constexpr VelodyneUnit kPuckHiresUnit = make_puck_hires();

class VelodynePuckHires : public VelodyneDecoder<kPuckHiresUnit> {
 public:
  static constexpr std::string_view kName = "Velodyne Puck Hi-Res";
  // The precision is 3 cm. One turn at 10 Hz in dual return mode takes 151 packets.
  static constexpr DataSheet kDataSheet = data_sheet_of_velodyne("velodyne_puck_hires", 160);
  // The elevation of each laser id, in wire order.
  static constexpr std::array<double, 16> kElevationsDeg{
      -10,    0.667, -8.667, 2,     -7.333, 3.333, -6,     4.667,  //
      -4.667, 6,     -3.333, 7.333, -2,     8.667, -0.667, 10};
};

}  // namespace iog::lidar
