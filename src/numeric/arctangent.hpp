// The angle of a direction.
//
// Bit by bit from the highest: the largest of 2^16 angles whose lower bound is not beyond the
// direction, by the sign of a cross product. So it is the nearest of them; the sines' error of
// 2^-21 can shift a bound by 0.005 of a step. 15 steps, of a sine and a cosine each.
#pragma once

#include <cstdint>

namespace iog::numeric {

// From the x axis towards the y axis, 2^-16 turns, at most 0.505 of a step off; 0 of (0, 0).
// |x|, |y| < 2^31, so that the products of two words stay below 2^61.
[[nodiscard]] std::uint16_t angle_of(std::int32_t x, std::int32_t y);

}  // namespace iog::numeric
