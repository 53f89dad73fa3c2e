// Finds the columns in which a line rises by one row. A line rises exactly when an addition
// produces a carry, so the algorithm is an exact digital differential analyser.
//
// Columns are numbered along the longer axis of the line (u), and rows along the other axis (v).
// The numbers increase in the direction of the line. Let w_u and w_v be the lengths of the line
// along these axes in subcells, so w_u >= w_v. A cell is r subcells wide. With u as the column
// axis, let e_c be the error term of the walk (traversal/walk.hpp) where the line enters column c.
// The line rises in that column if and only if e_c >= 0. The next error term is
//     e_{c+1} = e_c + r * w_v, minus r * w_u if the line rises.
//
// All e_c are congruent modulo r, so the walk can be computed as a rotation. Let y_c = floor(e_c /
// r) + w_u - w_v. The line then rises if y_c + w_v >= w_u. The next value is y_{c+1} = y_c + w_v,
// minus w_u if the line rises. In other words, y is taken modulo w_u, and the line rises whenever y
// wraps around. The value y_c / w_u is the height of the line above the bottom of its row at the
// left side of column c.
//
// The rotation can be computed in 32 bits. Scaled by 2^32 / w_u, the rotation becomes a 32-bit
// addition that produces a carry when the line rises:
//     phase = floor(2^32 * y / w_u) + 1,   step = floor(2^32 * w_v / w_u) + 1.
// `phase` and `step` are too large by at most 1, and never too small. After n columns, the phase
// therefore exceeds the exact phase by at most n + 1. No carry is missed. In a column without a
// carry, the sum y + w_v is an integer below w_u, so it is at most w_u - 1. No false carry
// therefore occurs while the excess is below 2^32 / w_u. This requires
//     (n + 1) * w_u < 2^32.
// Use most_columns() to check this condition. If w_u = w_v, the line rises in every column, which
// would require a step of 2^32. The code therefore uses a phase of 2^31 and a step of 2^32 - 1, so
// the addition produces a carry in each of the first 2^31 columns.
//
// Borders: If a line does not pass through a corner (traversal/corner.hpp), e_c is never 0 after
// its start. A line may also start on a border. If the start is on the lower or left border of its
// cell, all of the above still holds. If the start is on the upper left corner, the line enters its
// first column just below the upper border of its row. Using floor((e - 1) / r) keeps the line in
// that row. If the start is on the upper right corner, e_0 is 0 and the line rises in the first
// column. The computed line then enters the cell above, although the exact line does not.
#pragma once

#include <cstdint>
#include <limits>

#include "numeric/divisor.hpp"
#include "traversal/line.hpp"

namespace iog::traversal {

// The height of the line at the left side of a column, as an integer row and a phase in units of
// 2^-32 rows.
struct Dda {
  std::int32_t row = 0;  // row of the first column, relative to the row in which the line starts
  std::uint32_t phase = 0;
  std::uint32_t step = 0;  // phase increment per column, > 0

  // Advances to the next column. Returns `bits` shifted left by one, plus 1 if the line rises by a
  // row. The function uses one 64-bit addition so that it compiles to a single add with carry.
  [[nodiscard]] constexpr std::uint32_t advance(std::uint32_t bits) {
    const std::uint64_t shifted = static_cast<std::uint64_t>(bits) << 32;
    const std::uint64_t sum = (shifted | phase) + (shifted | step);
    phase = static_cast<std::uint32_t>(sum);
    return static_cast<std::uint32_t>(sum >> 32);
  }
};

// Returns how many columns can be computed exactly for a line of length w_u.
[[nodiscard]] constexpr std::uint32_t most_columns(std::uint32_t length_u) {
  return std::numeric_limits<std::uint32_t>::max() / (length_u + 1) - 1;
}

// Returns the Dda at `columns_before` columns before the start of the line. `is_steep` is true if y
// is the u axis.
template <std::int32_t kResolution>
[[nodiscard]] constexpr Dda dda_of(const Line<kResolution>& line, bool is_steep,
                                   std::uint32_t columns_before) {
  const Axis<kResolution>& u = is_steep ? line.y() : line.x();
  const Axis<kResolution>& v = is_steep ? line.x() : line.y();
  const auto around = static_cast<std::int32_t>(u.length());
  const auto rise = static_cast<std::int32_t>(v.length());
  const bool starts_above = u.offset() == 0 && v.offset() == kResolution;
  const std::int32_t error = (is_steep ? -line.error({}) : line.error({})) - (starts_above ? 1 : 0);
  std::int32_t y = numeric::div_floor(error, kResolution) + around - rise -
                   static_cast<std::int32_t>(columns_before) * rise;
  std::int32_t row = 0;
  for (; y < 0; --row) {
    y += around;
  }
  if (rise == around) {
    return {row, std::uint32_t{1} << 31, std::numeric_limits<std::uint32_t>::max()};
  }
  const numeric::Divisor divisor(u.length());
  const std::uint64_t height = static_cast<std::uint32_t>(y);
  return {row, divisor.divide(height << 32) + 1,
          divisor.divide(std::uint64_t{v.length()} << 32) + 1};
}

}  // namespace iog::traversal
