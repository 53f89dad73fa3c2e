// Finds lines that do not pass through any cell corner, except possibly at their start. Each step
// of the walk along such a line crosses exactly one border. The only exception is the first step of
// a line that starts on a corner, which may cross two.
//
// A line meets a corner exactly where the error term of its walk (traversal/walk.hpp) is 0. Let f
// be the offset of S in its cell and d = gcd(w_x, w_y). The points of the line on the subcell grid
// are S + k * (w_x, w_y) / d for k = 0 ... d. Such a point is a corner if f + k * w / d = 0 (mod r)
// on both axes. A line that meets a corner therefore satisfies all of the following conditions:
//   * Both w_x and w_y are above 0, because a line along an axis stays either inside a row or on
//     the lower border of a row.
//   * f_y * w_x = f_x * w_y (mod r). This congruence follows from the corner condition by
//     eliminating k.
//   * Either k = 0 and f = (r, r), or 1 <= k <= d. If k = 0, the line starts on the corner and
//     crosses it with its first step. If 1 <= k <= d, w_x / d and w_y / d have no common divisor,
//     so gcd(k, r) = gcd(f_x, f_y, r) = c. Hence c <= k and c <= d.
#pragma once

#include <cstdint>
#include <numeric>

#include "traversal/line.hpp"

namespace iog::traversal {

// Returns true if a line starts on a corner and crosses it with its first step.
template <std::int32_t kResolution>
[[nodiscard]] constexpr bool starts_on_corner(const Line<kResolution>& line) {
  constexpr auto kSide = static_cast<std::uint32_t>(kResolution);
  return line.x().offset() == kSide && line.y().offset() == kSide;
}

// Returns true if a line may meet a corner after its start. A result of false is certain, but a
// result of true may be wrong.
template <std::int32_t kResolution>
[[nodiscard]] constexpr bool may_meet_corner(const Line<kResolution>& line) {
  constexpr auto kSide = static_cast<std::uint32_t>(kResolution);
  const Axis<kResolution>& x = line.x();
  const Axis<kResolution>& y = line.y();
  if (line.error({}) % kResolution != 0 || (x.length() == 0) != (y.length() == 0)) {
    return false;
  }
  const std::uint32_t offsets = std::gcd(std::gcd(x.offset(), y.offset()), kSide);
  return std::gcd(x.length(), y.length()) >= offsets;
}

}  // namespace iog::traversal
