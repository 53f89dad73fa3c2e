// The values from a scanner's data sheet. Car files do not have to repeat these values.
#pragma once

#include <cstdint>
#include <string_view>

namespace iog::lidar {

// The defaults fit most spinning lidars, which have a precision of 3 cm and a range of at least 70
// m. The default grid extends 51 m to each side and 72 m to its corners, so longer ranges have no
// effect in this grid.
struct DataSheet {
  std::string_view type;           // name of the scanner in a car file
  std::string_view type_too{};     // name used by another manufacturer for the same unit
  std::uint32_t range_min_mm = 0;  // closer objects are not detected
  std::uint32_t range_max_mm = 73'000;
  std::uint32_t precision_mm = 30;
  double sigma_m = 0.03;
  std::uint16_t scan_width_ticks = 0;  // width of a whole scan; 0 means a turn
  // The maximum number of points per turn, plus a small margin. The value is 0 if the maximum
  // depends on the unit's settings. In this case, the car file must specify the maximum.
  std::uint32_t max_points_per_scan = 0;
  // The standard deviation of a radar's azimuth, or of the Gaussian distribution across an
  // ultrasonic sensor's cone.
  double azimuth_sigma_deg = 0;
};

}  // namespace iog::lidar
