// Converts a position to a direction and a distance using CORDIC (Volder, 1959), which computes
// each bit without a multiplication. CORDIC runs twice: the first run rotates the position about
// the z axis into the xz plane, and the second run rotates it about the y axis onto the x axis.
#pragma once

#include <cstdint>

namespace iog::numeric {

struct Polar {
  std::uint32_t azimuth = 0;   // from the x axis towards the y axis, in 2^-32 turns
  std::int32_t elevation = 0;  // from the xy plane towards z, in 2^-32 turns
  std::uint32_t range = 0;     // in the unit of x, y and z, rounded to the nearest integer
};

// Requires |x|, |y|, |z| <= 2^20. The range error is at most 0.55 input units. If the elevation is
// within +-89 degrees, the angle errors are at most 2^-21 turns. For (0, 0, 0), all results are 0.
// For a position straight up or down, the azimuth is 0.
[[nodiscard]] Polar polar_of(std::int32_t x, std::int32_t y, std::int32_t z);

}  // namespace iog::numeric
