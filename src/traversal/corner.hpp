// Lines that meet no corner: every step of theirs crosses one border.
//
// A line meets a corner exactly where the error term of its walk (traversal/walk.hpp) is 0. With f
// the offset of S in its cell and d = gcd(w_x, w_y), the grid points of the line are
// S + k (w_x, w_y) / d, and a corner is such a k with f + k w / d = 0 (mod r) on both axes. It
// needs
//   * f_y w_x = f_x w_y (mod r), by eliminating k;
//   * gcd(k, r) = gcd(f_x, f_y, r) = c, because w_x / d and w_y / d have no common divisor; so
//     1 <= k <= d is impossible if d < c;
//   * k = 0 is a corner that is yet to be crossed only if f = (r, r);
//   * w_x, w_y > 0: a line along an axis begins inside a row or at its lower border, and stays
//   there.
#pragma once

#include <cstdint>
#include <numeric>

#include "traversal/line.hpp"

namespace iog::traversal {

// Whether a line may meet a corner between its start and its end. False is certain.
template <std::int32_t kResolution>
[[nodiscard]] constexpr bool may_meet_corner(const Line<kResolution>& line) {
  constexpr auto kSide = static_cast<std::uint32_t>(kResolution);
  const Axis<kResolution>& x = line.x();
  const Axis<kResolution>& y = line.y();
  if (line.error({}) % kResolution != 0 || (x.length() == 0) != (y.length() == 0)) {
    return false;
  }
  const bool starts_on_corner = x.offset() == kSide && y.offset() == kSide;
  const std::uint32_t offsets = std::gcd(std::gcd(x.offset(), y.offset()), kSide);
  return starts_on_corner || std::gcd(x.length(), y.length()) >= offsets;
}

}  // namespace iog::traversal
