// The line of a beam on the grid, computed using integer arithmetic. A Line computes where the line
// crosses cell borders and how many borders it crosses up to any fraction of its length.
//
// See docs/model.md section 5, and section 4.2.2 and appendix B.3 of the thesis. A cell is r
// subcells wide, where r is the traversal resolution of the thesis. A line runs from its start S to
// its end E, both given in subcells. The line is mirrored into the first quadrant, so x and y
// increase in its direction.
//
// Position: A cell on a line is identified by how many column borders (x) and row borders (y) the
// line crosses before it enters the cell. The sum of the two counts, `crossed`, increases along the
// line. At a corner, a line crosses both borders at once and enters neither of the two adjacent
// cells, so `crossed` increases by two. All positions returned by these functions identify cells
// that the line actually enters.
//
// Ranges: let w = |E - S| for each axis, in subcells. If (w_x + w_y) * r < 2^31, the error term of
// the walk stays within 32 bits. This condition is asserted for the longest beam of a car. S and E
// are within +-2^29.
//   * through() and before() take a fraction num / den of the line, where num >= 0 and den > 0.
//     They require f * den + num * w < 2^63, where f (0 ... r) is the offset of S in its cell.
//   * All dividends are non-negative, and all results are rounded down.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <limits>
#include <optional>

#include "geometry/cell.hpp"
#include "numeric/division.hpp"
#include "numeric/reciprocal.hpp"

namespace iog::traversal {

using geometry::Cell;
using geometry::CellArea;
using geometry::SubcellPoint;

// The number of borders crossed since the start cell.
struct Position {
  std::uint32_t x = 0;
  std::uint32_t y = 0;
  [[nodiscard]] constexpr std::uint32_t crossed() const { return x + y; }
  friend constexpr bool operator==(const Position&, const Position&) = default;
};

// A fraction of a line's length, given as numerator / denominator.
struct Share {
  std::uint64_t numerator = 0;
  std::uint64_t denominator = 1;
};

// The length of a beam's line in millimetres, from 1 to 2^18 - 1, together with its reciprocal.
class LineLength {
 public:
  constexpr LineLength() = default;
  explicit constexpr LineLength(std::uint32_t length_mm)
      : length_mm_(length_mm), reciprocal_(length_mm) {}
  [[nodiscard]] constexpr std::uint32_t mm() const { return length_mm_; }
  [[nodiscard]] constexpr const numeric::Reciprocal& reciprocal() const { return reciprocal_; }

  // The inverse is floor(2^(32 + exponent) / mm), clamped to 32 bits. The exponent satisfies mm / 2
  // < 2^exponent <= mm.
  [[nodiscard]] constexpr std::uint32_t inverse() const { return inverse_; }
  [[nodiscard]] constexpr int exponent() const { return exponent_; }

 private:
  std::uint32_t length_mm_ = 1;
  numeric::Reciprocal reciprocal_{1};
  int exponent_ = static_cast<int>(std::bit_width(length_mm_)) - 1;
  std::uint32_t inverse_ = static_cast<std::uint32_t>(
      std::min<std::uint64_t>((std::uint64_t{1} << (32 + exponent_)) / length_mm_,
                              std::numeric_limits<std::uint32_t>::max()));
};

// One axis of a line, mirrored so that the line runs in the positive direction.
template <std::int32_t kResolution>
class Axis {
  static_assert(1 <= kResolution && kResolution <= std::numeric_limits<std::uint16_t>::max());
  static constexpr auto kSide = static_cast<std::uint32_t>(kResolution);

 public:
  constexpr Axis(std::int32_t start, std::int32_t end)
      : start_cell_(numeric::div_floor(start, kResolution)),
        step_(end < start ? -1 : 1),
        // Folding mirrors the axis. If the start is on a border, mirroring moves the start to the
        // far end of the cell, so the offset is r instead of 0.
        offset_(static_cast<std::uint16_t>(end < start ? (start_cell_ + 1) * kResolution - start
                                                       : start - start_cell_ * kResolution)),
        length_(static_cast<std::uint32_t>(end < start ? start - end : end - start)) {}

  [[nodiscard]] constexpr std::int32_t step() const { return step_; }
  [[nodiscard]] constexpr std::int32_t start_cell() const { return start_cell_; }
  [[nodiscard]] constexpr std::uint32_t offset() const { return offset_; }  // 0 ... r
  [[nodiscard]] constexpr std::uint32_t length() const { return length_; }
  [[nodiscard]] constexpr std::int32_t cell(std::uint32_t crossed) const {
    return start_cell_ + step_ * static_cast<std::int32_t>(crossed);
  }

  // Returns the number of borders crossed up to and including this fraction of the line.
  [[nodiscard]] constexpr std::uint32_t through(Share share) const {
    return static_cast<std::uint32_t>(scaled(share) / (share.denominator * kSide));
  }

  // Returns the number of borders crossed strictly before this fraction of the line.
  [[nodiscard]] constexpr std::uint32_t before(Share share) const {
    const std::uint64_t reached = scaled(share);
    return reached == 0 ? 0
                        : static_cast<std::uint32_t>((reached - 1) / (share.denominator * kSide));
  }

  // Returns the number of borders crossed strictly before the end of the line. Unlike before(),
  // this function divides only by a constant.
  [[nodiscard]] constexpr std::uint32_t before_end() const {
    const std::uint32_t reached = offset_ + length_;
    return reached == 0 ? 0 : (reached - 1) / kSide;
  }

  // Computes through() for the fraction distance / length without dividing by the length. Requires
  // distance < 2^20 mm. The quotient of the division by r is at most length + distance * w / r,
  // which is below 2^31 for lines of up to 2,000 cells.
  [[nodiscard]] constexpr std::uint32_t through(std::uint32_t distance_mm,
                                                const LineLength& length) const {
    const std::uint64_t reached =
        std::uint64_t{offset_} * length.mm() + std::uint64_t{distance_mm} * length_;
    return length.reciprocal().divide(static_cast<std::uint32_t>(reached / kSide));
  }

  // Returns the fraction of the line at which it crosses border n (n = 1, 2, ...). Requires
  // length() > 0 and n * r >= offset().
  [[nodiscard]] constexpr Share crossing(std::uint32_t n) const {
    return {std::uint64_t{n} * kSide - offset_, length_};
  }

  // Returns the distance from S to the next border after n crossings: (n + 1) * r - offset.
  [[nodiscard]] constexpr std::int64_t to_border(std::uint32_t n) const {
    return (std::int64_t{n} + 1) * kResolution - offset_;
  }

 private:
  [[nodiscard]] constexpr std::uint64_t scaled(Share share) const {
    return offset_ * share.denominator + share.numerator * length_;
  }

  // The members are kept small because many lines are cached.
  std::int32_t start_cell_;
  std::int16_t step_;
  std::uint16_t offset_;
  std::uint32_t length_;
};

// The part of a line inside an area, given by its first and last positions in the area.
struct Stretch {
  Position first;
  Position last;
};

template <std::int32_t kResolution>
class Line {
 public:
  constexpr Line(SubcellPoint start, SubcellPoint end) : x_(start.x, end.x), y_(start.y, end.y) {}

  [[nodiscard]] constexpr const Axis<kResolution>& x() const { return x_; }
  [[nodiscard]] constexpr const Axis<kResolution>& y() const { return y_; }
  [[nodiscard]] constexpr Cell cell(Position at) const { return {x_.cell(at.x), y_.cell(at.y)}; }

  // Returns the cell that contains the point at this fraction of the line. If the point is on a
  // border, returns the later cell.
  [[nodiscard]] constexpr Position through(Share share) const {
    return {x_.through(share), y_.through(share)};
  }
  // The function is not inlined because a Ruler calls it only about once per 2^12 distances.
  [[nodiscard, gnu::noinline]] constexpr Position through(std::uint32_t distance_mm,
                                                          const LineLength& length) const {
    return {x_.through(distance_mm, length), y_.through(distance_mm, length)};
  }

  // Returns the last cell whose interior the line enters before reaching this fraction of its
  // length.
  [[nodiscard]] constexpr Position before(Share share) const {
    return {x_.before(share), y_.before(share)};
  }

  [[nodiscard]] constexpr Position before_end() const { return {x_.before_end(), y_.before_end()}; }

  // Returns the error term of the walk at a position. The sign of the error term indicates on which
  // side of the line the next corner is. If the error term is negative, the line crosses the column
  // border first. If the error term is positive, the line crosses the row border first. If the
  // error term is 0, the line passes exactly through the corner.
  [[nodiscard]] constexpr std::int32_t error(Position at) const {
    return static_cast<std::int32_t>(x_.to_border(at.x) * std::int64_t{y_.length()} -
                                     y_.to_border(at.y) * std::int64_t{x_.length()});
  }

  // Extends the line indefinitely beyond its end and returns the part inside the area. Returns
  // nothing if the extended line never enters the area.
  [[nodiscard]] constexpr std::optional<Stretch> clip(CellArea area) const {
    Stretch stretch{{}, {kNoLimit, 0}};
    const bool hits = clip_axis(x_, y_, area.width, stretch, false) &&
                      clip_axis(y_, x_, area.height, stretch, true);
    return hits && stretch.first.crossed() <= stretch.last.crossed() ? std::optional(stretch)
                                                                     : std::nullopt;
  }

 private:
  // Clips `stretch` to the part in which the line's coordinate along `axis` is in [0, cells).
  // `other` is the other axis. `swapped` is true if `axis` is y. Returns false if this coordinate
  // is never in [0, cells).
  static constexpr bool clip_axis(const Axis<kResolution>& axis, const Axis<kResolution>& other,
                                  std::int32_t cells, Stretch& stretch, bool swapped) {
    const std::int32_t to_low =
        axis.step() > 0 ? -axis.start_cell() : axis.start_cell() - cells + 1;
    const std::int32_t to_high = to_low + cells - 1;
    if (to_high < 0 || (axis.length() == 0 && to_low > 0)) {
      return false;
    }
    if (to_low > 0) {
      const auto n = static_cast<std::uint32_t>(to_low);
      const std::uint32_t m = other.through(axis.crossing(n));
      if (n + m > stretch.first.crossed()) {
        stretch.first = swapped ? Position{m, n} : Position{n, m};
      }
    }
    if (axis.length() > 0) {
      const auto n = static_cast<std::uint32_t>(to_high);
      const std::uint32_t m = other.before(axis.crossing(n + 1));
      if (n + m < stretch.last.crossed()) {
        stretch.last = swapped ? Position{m, n} : Position{n, m};
      }
    }
    return true;
  }

  // No line crosses this many borders, and adding one to the limit does not overflow.
  static constexpr std::uint32_t kNoLimit = std::numeric_limits<std::uint32_t>::max() / 2;

  Axis<kResolution> x_;
  Axis<kResolution> y_;
};

}  // namespace iog::traversal
