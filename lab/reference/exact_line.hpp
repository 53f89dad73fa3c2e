// An exact reference for lines on a grid, written as geometry and not as a walk: which cells does
// the open interior of a cell share with the line, and at which shares of the line does it enter
// and leave them. Rational numbers in 64 bits: coordinates within 2^20 subcells.
#pragma once

#include <cstdint>
#include <optional>

#include "geometry/cell.hpp"

namespace iog::lab::reference {

struct Rational {
  std::int64_t numerator = 0;
  std::int64_t denominator = 1;  // > 0

  friend constexpr bool operator<(Rational a, Rational b) {
    return a.numerator * b.denominator < b.numerator * a.denominator;
  }
  friend constexpr bool operator<=(Rational a, Rational b) { return !(b < a); }
};

// Shares of the line, as if it went on for ever in both directions.
struct Crossing {
  Rational enter{-1, 1};
  Rational leave{1'000'000, 1};
};

// The part of one axis that lies in [low, low + r). A line that runs along the axis' border belongs
// to the cell above it, as the cell of a point does. False if there is none.
inline bool cut_axis(std::int32_t start, std::int32_t end, std::int32_t cell, std::int32_t r,
                     Crossing& crossing) {
  const std::int64_t extent = std::int64_t{end} - start;
  if (extent == 0) {
    return start >= std::int64_t{cell} * r && start < (std::int64_t{cell} + 1) * r;
  }
  const std::int64_t low = std::int64_t{cell} * r - start;
  const std::int64_t high = low + r;
  const Rational first = extent > 0 ? Rational{low, extent} : Rational{-high, -extent};
  const Rational last = extent > 0 ? Rational{high, extent} : Rational{-low, -extent};
  crossing.enter = crossing.enter < first ? first : crossing.enter;
  crossing.leave = last < crossing.leave ? last : crossing.leave;
  return true;
}

// Where the endless line enters and leaves the cell, nothing if it does not enter its interior.
inline std::optional<Crossing> cross(geometry::SubcellPoint start, geometry::SubcellPoint end,
                                     geometry::Cell cell, std::int32_t r) {
  Crossing crossing;
  const bool meets = cut_axis(start.x, end.x, cell.x, r, crossing) &&
                     cut_axis(start.y, end.y, cell.y, r, crossing);
  return meets && crossing.enter < crossing.leave ? std::optional(crossing) : std::nullopt;
}

// Whether the segment itself crosses the cell's interior.
inline bool segment_crosses(geometry::SubcellPoint start, geometry::SubcellPoint end,
                            geometry::Cell cell, std::int32_t r) {
  const std::optional<Crossing> crossing = cross(start, end, cell, r);
  return crossing && crossing->enter < Rational{1, 1} && Rational{0, 1} < crossing->leave;
}

}  // namespace iog::lab::reference
