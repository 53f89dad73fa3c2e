// The walk along a line that meets no corner: one border a step, so that the number of steps is
// the number of borders, and every step is the same few instructions without a branch.
//
// The walk of traversal/walk.hpp is the specification; this is its faster twin for nearly all
// lines. Its error term e says which border comes next: the column's if e < 0, which adds
// gain = r w_y to it, or the row's if e > 0, which subtracts r w_x = period - gain with
// period = r (w_x + w_y). So both add gain, and the row's subtracts the period. Here the term is
// kept as s = e - gain, and a step is
//     s += gain, which is e; if it is not below 0, the border is the row's: s -= period.
//
// Ranges. e lies in [-r w_x, r w_y], because the line passes through the cell; so s lies in
// [-period, 0], and period < 2^31 (traversal/line.hpp).
//
// Corners. A line meets a corner exactly where e = 0. With f the offset of S in its cell and
// d = gcd(w_x, w_y), the grid points of the line are S + k (w_x, w_y) / d, and a corner is such a k
// with f + k w / d = 0 (mod r) on both axes. It needs
//   * f_y w_x = f_x w_y (mod r), by eliminating k;
//   * gcd(k, r) = gcd(f_x, f_y, r) = c, because w_x / d and w_y / d have no common divisor; so
//     1 <= k <= d is impossible if d < c;
//   * k = 0 is a corner that is yet to be crossed only if f = (r, r).
// Where all three leave the possibility open, the line takes the general walk.
#pragma once

#include <cstddef>
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
  if (line.error({}) % kResolution != 0) {
    return false;
  }
  const bool starts_on_corner = x.offset() == kSide && y.offset() == kSide;
  const std::uint32_t offsets = std::gcd(std::gcd(x.offset(), y.offset()), kSide);
  return starts_on_corner || std::gcd(x.length(), y.length()) >= offsets;
}

// Walks over bytes stored row by row, `stride` apart. Only for lines that meet no corner.
template <typename Cell>
class SteadyWalk {
 public:
  // cells: the first is cell (0, 0). The walk may end, but never visits, outside of them: which is
  // why its place is an offset, that may be any number, and not a pointer.
  template <std::int32_t kResolution>
  SteadyWalk(const Line<kResolution>& line, Position from, Cell* cells, std::int32_t stride)
      : cells_(cells),
        offset_(line.cell(from).y * stride + line.cell(from).x),
        gain_(kResolution * static_cast<std::int32_t>(line.y().length())),
        period_(kResolution * static_cast<std::int32_t>(line.x().length() + line.y().length())),
        state_(line.error(from) - gain_),
        column_step_(line.x().step()),
        row_instead_(line.y().step() * stride - line.x().step()) {}

  // Visits the current cell and those after it: as many as `steps` says. Further calls go on from
  // there. Four steps at once spare the count of them.
  template <typename Visit>
  void visit(std::uint32_t steps, Visit&& visit) {
    SteadyWalk here =
        *this;  // in registers: a visit may store where the compiler suspects a member
    for (; steps >= kAtOnce; steps -= kAtOnce) {
      for (std::uint32_t i = 0; i < kAtOnce; ++i) {
        visit(here.cells_[here.offset_]);
        here.step();
      }
    }
    for (; steps > 0; --steps) {
      visit(here.cells_[here.offset_]);
      here.step();
    }
    *this = here;
  }

 private:
  static constexpr std::uint32_t kAtOnce = 4;

  void step() {
    offset_ += column_step_;
    state_ += gain_;
    if (state_ >= 0) {
      state_ -= period_;
      offset_ += row_instead_;
    }
  }

  Cell* cells_;
  std::ptrdiff_t offset_;
  std::int32_t gain_;
  std::int32_t period_;
  std::int32_t state_;
  std::ptrdiff_t column_step_;
  std::ptrdiff_t row_instead_;
};

}  // namespace iog::traversal
