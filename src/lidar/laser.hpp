// The manufacturer's calibration of a unit's lasers.
#pragma once

#include <cstdint>

namespace iog::lidar {

// The calibration of one laser, as given in the car file. `docs/sensors.md` describes how to
// convert a manufacturer's file to a table of lasers.
struct Laser {
  double elevation_deg = 0;  // -90 to 90, positive up
  double azimuth_deg = 0;    // offset to the left of the direction in the packet, -30 to 30
  double height_m = 0;       // height of the beam's start above the origin, normal to the beam
  double range_m = 0;        // offset added to every range, -10 to 10
};

// The corrections for the scan points of one laser, as integers.
struct LaserCorrection {
  std::int16_t azimuth_ticks = 0;  // counter-clockwise; at most one twelfth of a turn
  std::int16_t range_mm = 0;
};

// Corrects a range. A range of 0 (no return) remains 0, and all other ranges remain above 0.
[[nodiscard]] constexpr std::uint32_t corrected_range_mm(std::uint32_t range_mm,
                                                         std::int32_t correction_mm) {
  if (range_mm == 0) {
    return 0;
  }
  const std::uint32_t sum = range_mm + static_cast<std::uint32_t>(correction_mm);
  return static_cast<std::int32_t>(sum) > 1 ? sum : 1;
}

}  // namespace iog::lidar
