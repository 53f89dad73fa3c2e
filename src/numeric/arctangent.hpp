// Computes the angle of a direction.
//
// The angle is computed bit by bit, starting with the highest bit. Each of the 2^16 possible angles
// has a lower bound. The result is the largest angle whose lower bound does not exceed the angle of
// the direction. The sign of a cross product shows whether a bound exceeds this angle. The result
// is the angle nearest to the direction, except that the sine error of 2^-21 can shift the lower
// bound by up to 0.005 steps. The computation takes 15 steps, each with one sine and one cosine.
#pragma once

#include <cstdint>

namespace iog::numeric {

// Returns the angle from the x axis towards the y axis in units of 2^-16 turns, with an error of at
// most 0.505 units. The angle of (0, 0) is 0. The absolute values of x and y must be below 2^31, so
// that the products stay below 2^61.
[[nodiscard]] std::uint16_t angle_of(std::int32_t x, std::int32_t y);

}  // namespace iog::numeric
