// The angle of a direction.
//
// The angle is computed bit by bit, starting with the highest bit. Of 2^16 angles, the result is
// the largest whose lower bound is not beyond the direction. The bound and the direction are
// compared by the sign of their cross product. The result is the nearest of the angles, except that
// the sine error of 2^-21 can shift its lower bound by up to 0.005 steps. The computation takes 15
// steps with one sine and one cosine each.
#pragma once

#include <cstdint>

namespace iog::numeric {

// The angle from the x axis towards the y axis in units of 2^-16 turns, with an error of at most
// 0.505 units. The angle of (0, 0) is 0. Requires |x|, |y| < 2^31 to keep the products below 2^61.
[[nodiscard]] std::uint16_t angle_of(std::int32_t x, std::int32_t y);

}  // namespace iog::numeric
