// Values from the data sheet of a scanner, which a car file need not repeat.
#pragma once

#include <cstdint>
#include <string_view>

namespace iog::lidar {

// The defaults fit most spinning lidars: a precision of 3 cm, and a range of 70 m or more. The grid
// ends 51 m away, or 72 m at its corners, and shows nothing beyond.
struct DataSheet {
  std::string_view type;           // its name in a car file
  std::string_view type_too{};     // another maker's name for the same unit
  std::uint32_t range_min_mm = 0;  // nearer objects are not seen
  std::uint32_t range_max_mm = 73'000;
  std::uint32_t precision_mm = 30;
  double sigma_m = 0.03;
  std::uint16_t scan_width_ticks = 0;  // of a whole scan; 0: a turn
  // Maximum number of points per turn, with a small margin. 0: it depends on the settings of the
  // unit, and the car file must give it.
  std::uint32_t max_points_per_scan = 0;
  // Standard deviation of a radar's azimuth, or of an ultrasonic unit's cone.
  double azimuth_sigma_deg = 0;
};

}  // namespace iog::lidar
