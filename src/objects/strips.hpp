// Which rectangles may be near to which, asked before anything is measured.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "objects/plane.hpp"
#include "objects/rules.hpp"

namespace iog::objects {

// The columns and rows of 1 m in which a rectangle has a part, a bit each; those that are 32 apart
// share a bit. What shares no column or no row does not meet.
struct Strips {
  std::uint32_t columns = 0;
  std::uint32_t rows = 0;

  // Of a rectangle that is so much larger on each side.
  [[nodiscard]] static constexpr Strips of(const Bounds& bounds, std::int32_t more_mm) {
    return {.columns = bits(bounds.low.x_mm - more_mm, bounds.high.x_mm + more_mm),
            .rows = bits(bounds.low.y_mm - more_mm, bounds.high.y_mm + more_mm)};
  }
  [[nodiscard]] constexpr bool may_meet(const Strips& other) const {
    // One branch instead of two that nobody can foresee.
    return std::min(columns & other.columns, rows & other.rows) != 0;
  }

 private:
  static constexpr int kStripBits = 10;

  [[nodiscard]] static constexpr std::uint32_t bits(std::int32_t low_mm, std::int32_t high_mm) {
    const std::int32_t first = low_mm >> kStripBits;
    const std::int32_t more = (high_mm >> kStripBits) - first;
    return more >= 31 ? ~std::uint32_t{0} : std::rotl((std::uint32_t{2} << more) - 1, first & 31);
  }
};

// Those of up to kMostTracks rectangles, by their numbers.
class StripsOfAll {
 public:
  void set(std::size_t number, const Strips& its) { all_[number] = its; }
  [[nodiscard]] const Strips& operator[](std::size_t number) const { return all_[number]; }

  // The first number from `from` on, below `end`, of which the strips may meet these; else `end`.
  [[nodiscard]] std::size_t next(const Strips& its, std::size_t from, std::size_t end) const {
    while (from < end && !all_[from].may_meet(its)) {
      ++from;
    }
    return from;
  }

 private:
  std::array<Strips, kMostTracks> all_{};
};

}  // namespace iog::objects
