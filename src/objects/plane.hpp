// Points, velocities and boxes in the local frame.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/cell.hpp"
#include "geometry/sizes.hpp"
#include "numeric/magnitude.hpp"

namespace iog::objects {

// The absolute value of each coordinate is at most 1.1 * 10^9 mm. The difference between two points
// in one window fits into a word.
struct Point {
  std::int32_t x_mm = 0;
  std::int32_t y_mm = 0;
  friend constexpr bool operator==(const Point&, const Point&) = default;
};

[[nodiscard]] constexpr Point centre_of(geometry::Cell cell) {
  return {cell.x * geometry::kCellMm + geometry::kCellMm / 2,
          cell.y * geometry::kCellMm + geometry::kCellMm / 2};
}

// A velocity in mm/s. The absolute value of each component is at most kMostSpeed.
struct Velocity {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend constexpr bool operator==(const Velocity&, const Velocity&) = default;
};

// Returns the position of a point after it has moved with the given velocity for `ms` milliseconds.
// `ms` may be negative. The absolute value of `ms` must be at most 1024, so that products stay
// below 2^27.
[[nodiscard]] constexpr Point moved(Point from, Velocity by, std::int32_t ms) {
  return {from.x_mm + by.x * ms / 1000, from.y_mm + by.y * ms / 1000};
}

// Approximates the distance by max(|dx|, |dy|) + 3/8 * min(|dx|, |dy|). The error is at most 1/16
// of the distance.
[[nodiscard]] constexpr std::int32_t range_mm(Point from, Point to) {
  const std::int32_t dx = numeric::magnitude(to.x_mm - from.x_mm);
  const std::int32_t dy = numeric::magnitude(to.y_mm - from.y_mm);
  const std::int32_t shorter = std::min(dx, dy);
  return std::max(dx, dy) + shorter / 2 - shorter / 8;
}

// A unit vector in units of 2^-14.
struct Direction {
  std::int32_t x = 1 << 14;
  std::int32_t y = 0;
  friend constexpr bool operator==(const Direction&, const Direction&) = default;
};
inline constexpr int kDirectionBits = 14;

// The two axes of a box. kAcross points 90 degrees to the left of kAlong.
enum Side : std::size_t { kAlong, kAcross };
inline constexpr std::array kSides{kAlong, kAcross};

[[nodiscard]] constexpr Direction side_of(Direction along, Side side) {
  return side == kAlong ? along : Direction{-along.y, along.x};
}

struct Interval {
  std::int32_t low = 0;
  std::int32_t high = 0;
  [[nodiscard]] constexpr std::int32_t length() const { return high - low; }
  constexpr void include(std::int32_t value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  friend constexpr bool operator==(const Interval&, const Interval&) = default;
};
using Sides = std::array<Interval, 2>;

[[nodiscard]] constexpr std::int32_t longest_of(const Sides& sides) {
  return std::max(sides[kAlong].length(), sides[kAcross].length());
}

// A rectangle around a reference point. The reference point is not necessarily the centre of the
// rectangle.
struct Box {
  Point at{};
  Direction along{};
  Sides sides{};  // mm from the reference point

  // Returns the coordinate of a point along one axis of the box, relative to the reference point
  // and rounded down. Products are computed in 64 bits.
  [[nodiscard]] constexpr std::int32_t place(Point point, Side side) const {
    const std::int64_t dx = point.x_mm - at.x_mm;
    const std::int64_t dy = point.y_mm - at.y_mm;
    const Direction axis = side_of(along, side);
    return static_cast<std::int32_t>((dx * axis.x + dy * axis.y) >> kDirectionBits);
  }
  // Returns how far a point is outside the box. The result is the larger of the distances along the
  // two axes, or 0 if the point is inside the box.
  [[nodiscard]] constexpr std::int32_t outside(Point point) const {
    std::int32_t most = 0;
    for (const Side side : kSides) {
      const std::int32_t its = place(point, side);
      most = std::max({most, sides[side].low - its, its - sides[side].high});
    }
    return most;
  }
  // Returns true if the line between two points crosses the box. Both points must be within 2^17 mm
  // of the box, so that products of two words stay below 2^40.
  [[nodiscard]] constexpr bool is_between(Point from, Point to) const {
    // The line enters the box at the fraction `enters / enters_of` of its length and leaves it at
    // the fraction `leaves / leaves_of`. The line misses the box if the first fraction is larger.
    std::int64_t enters = 0;
    std::int64_t enters_of = 1;
    std::int64_t leaves = 1;
    std::int64_t leaves_of = 1;
    for (const Side side : kSides) {
      const Interval its = sides[side];
      const std::int64_t start = place(from, side);
      const std::int64_t way = place(to, side) - start;
      if (way == 0 && (start < its.low || start > its.high)) {
        return false;
      }
      const std::int64_t length = numeric::magnitude(way);
      const std::int64_t in = way > 0 ? its.low - start : start - its.high;
      const std::int64_t out = way > 0 ? its.high - start : start - its.low;
      if (way != 0 && in * enters_of > enters * length) {
        enters = in;
        enters_of = length;
      }
      if (way != 0 && out * leaves_of < leaves * length) {
        leaves = out;
        leaves_of = length;
      }
    }
    return enters * leaves_of <= leaves * enters_of;
  }
  // Returns a corner of the box. `number` is in the range 0 to 3. Bit 0 selects the high end of
  // kAlong, and bit 1 selects the high end of kAcross.
  [[nodiscard]] constexpr Point corner(unsigned number) const {
    const std::int64_t a = number & 1U ? sides[kAlong].high : sides[kAlong].low;
    const std::int64_t b = number & 2U ? sides[kAcross].high : sides[kAcross].low;
    return {at.x_mm + static_cast<std::int32_t>((a * along.x - b * along.y) >> kDirectionBits),
            at.y_mm + static_cast<std::int32_t>((a * along.y + b * along.x) >> kDirectionBits)};
  }
};

// An axis-aligned rectangle. contains() and is_near() combine four sign checks into one branch,
// because four separate branches would be hard to predict.
struct Bounds {
  Point low{INT32_MAX, INT32_MAX};
  Point high{INT32_MIN, INT32_MIN};

  constexpr void include(Point point) {
    low = {std::min(low.x_mm, point.x_mm), std::min(low.y_mm, point.y_mm)};
    high = {std::max(high.x_mm, point.x_mm), std::max(high.y_mm, point.y_mm)};
  }
  [[nodiscard]] constexpr Point corner(unsigned number) const {
    return {number & 1U ? high.x_mm : low.x_mm, number & 2U ? high.y_mm : low.y_mm};
  }
  [[nodiscard]] constexpr Point middle() const {
    return {low.x_mm + (high.x_mm - low.x_mm) / 2, low.y_mm + (high.y_mm - low.y_mm) / 2};
  }
  [[nodiscard]] constexpr bool contains(Point point) const {
    return ((point.x_mm - low.x_mm) | (high.x_mm - point.x_mm) | (point.y_mm - low.y_mm) |
            (high.y_mm - point.y_mm)) >= 0;
  }
  [[nodiscard]] constexpr Bounds grown(std::int32_t mm) const {
    return {.low = {low.x_mm - mm, low.y_mm - mm}, .high = {high.x_mm + mm, high.y_mm + mm}};
  }
  [[nodiscard]] constexpr bool meets(const Bounds& other) const { return is_near(other, 0); }
  // Returns true if two rectangles are at most `mm` apart on both axes.
  [[nodiscard]] constexpr bool is_near(const Bounds& other, std::int32_t mm) const {
    return ((high.x_mm - other.low.x_mm + mm) | (other.high.x_mm - low.x_mm + mm) |
            (high.y_mm - other.low.y_mm + mm) | (other.high.y_mm - low.y_mm + mm)) >= 0;
  }
};

[[nodiscard]] constexpr Bounds bounds_of(const Box& box) {
  Bounds bounds;
  for (unsigned number = 0; number < 4; ++number) {
    bounds.include(box.corner(number));
  }
  return bounds;
}

}  // namespace iog::objects
