// Computes the angle of a direction.
//
// The angle is computed bit by bit, starting with the highest bit. A bit is set if the resulting
// angle, minus half a unit, does not exceed the angle of the direction. The sign of a cross product
// shows whether this is the case. The result is therefore the integer angle nearest to the
// direction, except that the sine error of 2^-21 can shift this threshold by up to 0.005 units. The
// computation takes 15 steps, each with one sine and one cosine.
#pragma once

#include <cstdint>

namespace iog::numeric {

// Returns the angle from the x axis towards the y axis in units of 2^-16 turns, with an error of at
// most 0.505 units. The angle of (0, 0) is 0. The absolute values of `x` and `y` must be below 2^31
// to keep the products below 2^61.
[[nodiscard]] std::uint16_t angle_of(std::int32_t x, std::int32_t y);

}  // namespace iog::numeric
