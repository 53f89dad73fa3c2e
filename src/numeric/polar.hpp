// A place as a direction and a distance, without a multiplication per bit: CORDIC (J. E. Volder,
// 1959), once about z and once about the horizontal axis that is left.
#pragma once

#include <cstdint>

namespace iog::numeric {

struct Polar {
  std::uint32_t azimuth = 0;   // from x towards y, 2^-32 turns
  std::int32_t elevation = 0;  // from the plane of x and y towards z, the same
  std::uint32_t range = 0;     // in the unit of x, y and z, to the nearest
};

// |x|, |y|, |z| <= 2^20. The range is within 0.55 of the true one, and angles within 2^-21 turns if
// the elevation is within 89 degrees. Of (0, 0, 0) all are 0; straight up or down the azimuth is.
[[nodiscard]] Polar polar_of(std::int32_t x, std::int32_t y, std::int32_t z);

}  // namespace iog::numeric
