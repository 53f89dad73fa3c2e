// Converts a position to direction and distance using CORDIC (Volder, 1959), without a
// multiplication per bit. CORDIC runs twice: once about z and once about the remaining horizontal
// axis.
#pragma once

#include <cstdint>

namespace iog::numeric {

struct Polar {
  std::uint32_t azimuth = 0;   // from the x axis towards the y axis, in 2^-32 turns
  std::int32_t elevation = 0;  // from the xy plane towards z, in 2^-32 turns
  std::uint32_t range = 0;     // in the unit of x, y and z, rounded to the nearest integer
};

// Requires |x|, |y|, |z| <= 2^20. The error of the range is at most 0.55. The error of the angles
// is at most 2^-21 turns if the elevation is within 89 degrees. All results are 0 for (0, 0, 0).
// The azimuth is 0 for a position straight up or down.
[[nodiscard]] Polar polar_of(std::int32_t x, std::int32_t y, std::int32_t z);

}  // namespace iog::numeric
