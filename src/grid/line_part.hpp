// Boundaries between the cells of a line, and parts of a line between two boundaries.
#pragma once

#include <algorithm>
#include <cstdint>

#include "traversal/line.hpp"

namespace iog::grid {

// A boundary between two consecutive cells of a line. A boundary has one of two forms: `before`
// refers to the next cell, and `after` refers to the previous cell. A boundary is stored as one
// number that increases along the line. The upper 16 bits count the borders crossed to reach the
// next cell. The next bit is set in the form `before`, and the lowest 15 bits contain the x
// coordinate of the position. The form `after` sorts before the form `before` of the same boundary.
// In the form `after`, the next cell can lie outside the grid.
class Between {
 public:
  constexpr Between() = default;  // before the first cell
  static constexpr Between before(traversal::Position at) {
    return Between(at.crossed() << 16 | kIsBefore | at.x);
  }
  static constexpr Between after(traversal::Position at) {
    return Between((at.crossed() + 1) << 16 | at.x);
  }
  // Creates a boundary from the value of crossed() and the lower half of bits().
  static constexpr Between of(std::uint32_t crossed, std::uint32_t lower_half) {
    return Between(crossed << 16 | lower_half);
  }

  // Returns how many cell borders the line crosses from its start up to and including this
  // boundary. A cell lies before the boundary if the line crosses fewer borders than this to reach
  // the cell.
  [[nodiscard]] constexpr std::uint32_t crossed() const { return bits_ >> 16; }
  [[nodiscard]] constexpr bool is_after() const { return (bits_ & kIsBefore) == 0; }
  [[nodiscard]] constexpr traversal::Position at() const {
    const std::uint32_t x = bits_ & (kIsBefore - 1);
    return {x, crossed() - (is_after() ? 1U : 0U) - x};
  }
  [[nodiscard]] constexpr std::uint32_t bits() const { return bits_; }
  // NOLINTNEXTLINE(modernize-use-nullptr): clang-tidy 14 mistakes an implicit 0 for a pointer
  friend constexpr auto operator<=>(Between, Between) = default;

 private:
  static constexpr std::uint32_t kIsBefore = 1U << 15;
  explicit constexpr Between(std::uint32_t bits) : bits_(bits) {}

  std::uint32_t bits_ = kIsBefore;
};

// A part of a line, from one boundary to another.
struct LinePart {
  Between first;
  Between end;

  [[nodiscard]] bool is_empty() const { return first.crossed() >= end.crossed(); }
  // Returns the part up to `limit`. Unlike std::min(), this compares values, so that the compiler
  // keeps them in registers.
  [[nodiscard]] LinePart up_to(Between limit) const { return {first, limit < end ? limit : end}; }
  // Returns the intersection of two parts.
  [[nodiscard]] LinePart within(const LinePart& other) const {
    return {std::max(first, other.first), std::min(end, other.end)};
  }
};

}  // namespace iog::grid
