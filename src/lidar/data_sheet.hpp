// What the data sheet of a scanner says, which the file of a car need not repeat.
#pragma once

#include <cstdint>
#include <string_view>

namespace iog::lidar {

// The numbers of most lidars that turn stand here: precise to 3 cm. They see 70 m or more; the grid
// ends 51 m away and 72 m in its corners, and nothing beyond can be seen on it.
struct DataSheet {
  std::string_view type;           // its name in a car's file
  std::string_view type_too{};     // another maker's name of the same
  std::uint32_t range_min_mm = 0;  // it sees nothing that is nearer
  std::uint32_t range_max_mm = 73'000;
  std::uint32_t precision_mm = 30;
  double sigma_m = 0.03;
  std::uint16_t scan_width_ticks = 0;  // of a whole scan; 0: a turn
  // Of one turn, some more than it can have; 0: it depends on how the unit is set up, and the file
  // of a car must say it.
  std::uint32_t max_points_per_scan = 0;
  // Of a radar: standard deviation of an azimuth. Of an ultrasonic unit: that of its cone.
  double azimuth_sigma_deg = 0;
};

}  // namespace iog::lidar
