// Decides whether two lines with the same start cross the same cells. Lines that cross the same
// cells can be carved in one walk. At a given azimuth, the lines of a lidar's layers are nearly
// identical. These lines differ only in length and in how their ends are rounded.
//
// Where the lines diverge: Two lines A and B diverge at a corner that lies between them. At a
// corner with the offset (X, Y) from S, the error terms of the lines (traversal/line.hpp) are e_A =
// X * A_y - Y * A_x and e_B = X * B_y - Y * B_x. Let c = A_x * B_y - A_y * B_x, s_A = A_x + A_y and
// s_B = B_x + B_y. The error terms then satisfy
//     s_A * e_B = s_B * e_A + (X + Y) * c.
// After n common borders, the lines can cross different borders next only if both of the following
// hold: e_A and c have opposite signs, and s_B * |e_A| <= (X + Y) * |c|, where X + Y <= (n + 2) *
// r. The second condition restricts e_A to a narrow strip next to 0. As long as no error term of A
// lies in the strip, B crosses the same borders as A.
//
// How the strip is searched: A column step adds r * A_y to the error term of A, and a row step
// subtracts r * A_x. Modulo r * s_A, each term is therefore the previous term plus r * A_y. If the
// terms are divided by r and rounded down, each step adds A_y modulo s_A, so the terms form a
// rotation. Let t = floor((n + 2) * |c| / s_B) + 1. The strip is contained in [0, t] if c < 0 and
// in [-1 - t, -1] if c > 0. Mirroring x to -1 - x reduces the second case to the first, with a
// rotation by A_x. A variant of Euclid's algorithm finds, in about ten steps, the first term of a
// rotation that lies in [0, t].
//
// Ranges: s_A and s_B are below 2^31 / r (traversal/line.hpp). The result is false unless |c| <
// 2^20 and n + 2 < 2^12, because lines in different directions are not worth examining further.
#pragma once

#include <algorithm>
#include <cstdint>

#include "numeric/division.hpp"
#include "traversal/corner.hpp"
#include "traversal/line.hpp"

namespace iog::traversal {

// Several consecutive steps of a rotation, which together move the value up or down by `angle`.
struct Turn {
  std::uint32_t angle = 0;
  std::uint32_t steps = 0;

  // Appends `times` repetitions of `other`, which moves the value in the opposite direction. This
  // reduces the angle.
  constexpr void shorten(const Turn& other, std::uint32_t times) {
    angle -= times * other.angle;
    steps += times * other.steps;
  }
};

// Finds the first term of a rotation that is at most `threshold`, and returns its number (0 for the
// first term). Returns `limit` if the first `limit` terms are all greater than `threshold`. The
// rotation starts at x. Each step moves down by `down_angle`, which is the same as moving up by
// `up_angle` modulo down_angle + up_angle. Requires x < down_angle + up_angle < 2^31 and limit <
// 2^12.
//
// The first term that is at most `threshold` is a new minimum: it is smaller than all terms before
// it. To move from each minimum x to the next, the algorithm uses the downward Turn with the fewest
// steps among those with an angle of at most x. As in Euclid's algorithm, it finds downward Turns
// with smaller and smaller angles. To find them, it alternately reduces the smallest downward angle
// and the smallest upward angle found so far by multiples of each other. The two angles add up to
// at most down_angle + up_angle, and so do the two step counts, so nothing overflows.
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
        return limit;  // the rotation has completed a full circle
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

// Returns true if `a` and `b` cross the same cells up to and including their first `borders`
// borders. A result of true is certain, but a result of false may be wrong. Both lines must start
// at the same point. Line `a` must not pass through a corner after its start. If the lines start on
// a corner, both must cross this corner first.
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
  const bool on_corner = starts_on_corner(a);
  const std::uint32_t left = borders - std::min<std::uint32_t>(borders, on_corner ? 2 : 0);
  const Position from = on_corner ? Position{1, 1} : Position{};
  const std::int32_t first = numeric::div_floor(a.error(from), kResolution);
  const std::int32_t x = c < 0 ? first : -1 - first;
  const std::uint32_t down = c < 0 ? a.x().length() : a.y().length();
  const std::uint32_t start = static_cast<std::uint32_t>(x) + (x < 0 ? circle : 0);
  return first_not_above(threshold, start, down, circle - down, left) == left;
}

}  // namespace iog::traversal
