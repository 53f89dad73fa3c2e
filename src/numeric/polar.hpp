// Converts a position to direction and distance without a multiplication per bit: CORDIC (J. E.
// Volder, 1959), once about z and once about the remaining horizontal axis.
#pragma once

#include <cstdint>

namespace iog::numeric {

struct Polar {
  std::uint32_t azimuth = 0;   // from x towards y, 2^-32 turns
  std::int32_t elevation = 0;  // from the plane of x and y towards z, 2^-32 turns
  std::uint32_t range = 0;     // in the unit of x, y and z, rounded to the nearest
};

// The inputs satisfy |x|, |y|, |z| <= 2^20. The range is within 0.55 of the true one, and angles
// are within 2^-21 turns if the elevation is within 89 degrees. Everything is 0 for (0, 0, 0), and
// the azimuth is 0 straight up or down.
[[nodiscard]] Polar polar_of(std::int32_t x, std::int32_t y, std::int32_t z);

}  // namespace iog::numeric
