// Whether two lines from one start go through the same cells: then what is to be done in the cells
// of both is done in one walk. All layers of a lidar have nearly the same line at one azimuth: it
// differs in its length, and in how its end was rounded.
//
// Two lines A and B part where a corner lies between them. At a corner, X and Y away from S, their
// error terms (traversal/line.hpp) are e_A = X A_y - Y A_x and e_B = X B_y - Y B_x. With
// c = A_x B_y - A_y B_x, A = A_x + A_y and B = B_x + B_y,
//     A e_B = B e_A + (X + Y) c.
// So while both have taken the same n borders, they disagree about the next one only if e_A and c
// have opposite signs and B |e_A| <= (X + Y) |c|, where X + Y <= (n + 2) r. If none of A's terms
// lies in that strip beside 0, B takes the same borders as A.
//
// Each of A's terms is the one before plus r A_y, modulo r A: a column step adds r A_y, a row step
// subtracts r A_x. Divided by r, rounded down, they are a rotation by A_y modulo A, and the strip
// is contained in [0, t] for c < 0 and in [-1 - t, -1] for c > 0, with t = floor((n + 2) |c| / B)
// + 1. Mirrored, x to -1 - x, the second is the first of a rotation by A_x.
//
// Ranges. A and B < 2^31 / r (traversal/line.hpp). |c| < 2^20 and n + 2 < 2^12, or the answer is
// no: lines of different directions are not worth a closer look.
#pragma once

#include <algorithm>
#include <cstdint>

#include "numeric/division.hpp"
#include "traversal/line.hpp"

namespace iog::traversal {

// A turn of a rotation: the angle of that many steps, to one side.
struct Turn {
  std::uint32_t angle = 0;
  std::uint32_t steps = 0;

  // Goes so many times to the other side.
  constexpr void shorten(const Turn& other, std::uint32_t times) {
    angle -= times * other.angle;
    steps += times * other.steps;
  }
};

// The number of the first term of a rotation that is at most `threshold`, or `limit` if there is
// none among the first `limit` of them. It begins at x; a step goes down by `down` or, which is the
// same modulo down + up, up by `up`. x < down + up < 2^31, limit < 2^12.
//
// Only terms that are less than all before count. The next of these comes with the first turn
// downwards by no more than x. Turns downwards that are shorter than all before are found as by
// Euclid: the shortest so far, less the shortest upwards so far. Both turns together are the whole
// circle or less, and their steps are at most as many, so nothing overflows.
[[nodiscard]] constexpr std::uint32_t first_not_above(std::uint32_t threshold, std::uint32_t x,
                                                      std::uint32_t down_angle,
                                                      std::uint32_t up_angle, std::uint32_t limit) {
  Turn down{down_angle, 1};
  Turn up{up_angle, 1};
  std::uint32_t number = 0;
  while (x > threshold) {
    if (number + down.steps >= limit) {
      return limit;
    }
    if (down.angle <= x) {
      if (down.angle == 0) {
        return limit;  // the rotation has come round
      }
      const std::uint32_t times = x / down.angle;
      const std::uint32_t rest = x - times * down.angle;
      if (rest <= threshold) {
        const std::uint32_t needed = (x - threshold + down.angle - 1) / down.angle;
        return std::min(number + needed * down.steps, limit);
      }
      x = rest;
      number += times * down.steps;
    } else {
      if (up.angle >= down.angle) {
        up.shorten(down, up.angle / down.angle);
      }
      if (up.angle == 0) {
        return limit;
      }
      const std::uint32_t wanted = (down.angle - x + up.angle - 1) / up.angle;
      down.shorten(up, std::min(wanted, down.angle / up.angle));
    }
  }
  return number;
}

// Whether b goes through the cells of a until `borders` are crossed. True is certain. Both begin at
// the same point, and a meets no corner.
template <std::int32_t kResolution>
[[nodiscard]] constexpr bool same_cells(const Line<kResolution>& a, const Line<kResolution>& b,
                                        std::uint32_t borders) {
  constexpr std::int64_t kLimitOfC = std::int64_t{1} << 20;
  constexpr std::uint32_t kLimitOfN = std::uint32_t{1} << 12;
  if (a.x().step() != b.x().step() || a.y().step() != b.y().step()) {
    return false;
  }
  const std::int64_t c =
      std::int64_t{a.x().length()} * b.y().length() - std::int64_t{a.y().length()} * b.x().length();
  const std::uint32_t b_length = b.x().length() + b.y().length();
  if (c <= -kLimitOfC || c >= kLimitOfC || borders + 2 >= kLimitOfN || b_length == 0) {
    return false;
  }
  if (c == 0) {
    return true;
  }
  const auto c_size = static_cast<std::uint32_t>(c < 0 ? -c : c);
  const std::uint32_t threshold = (borders + 2) * c_size / b_length + 1;
  const std::uint32_t circle = a.x().length() + a.y().length();
  const std::int32_t first = numeric::div_floor(a.error({}), kResolution);
  const std::int32_t x = c < 0 ? first : -1 - first;
  const std::uint32_t down = c < 0 ? a.x().length() : a.y().length();
  const std::uint32_t start = static_cast<std::uint32_t>(x) + (x < 0 ? circle : 0);
  return first_not_above(threshold, start, down, circle - down, borders) == borders;
}

}  // namespace iog::traversal
