// Sine and cosine of an angle in 2^-32 turns, which wraps as its integer does.
//
// A table of 4096 values a turn, each rounded to the nearest 2^-30, and a straight line between two
// of them. With h = 2 pi / 4096 the line is at most h^2 / 8 < 2.95e-7 away from the sine; the
// rounding of the table and of the result adds at most 2^-30. So the error is below 2^-21, which is
// 0.03 mm at a distance of 50 m. At the table's own angles the value is the table's.
#pragma once

#include <cstdint>

#include "numeric/sine_table.hpp"

namespace iog::numeric {

// Cosine and sine in 2^-30, each within +-2^30.
struct Rotation {
  std::int32_t cos_q30 = 1 << kSineFractionBits;
  std::int32_t sin_q30 = 0;
};

// sine of angle / 2^32 turns, -2^30 ... 2^30.
[[nodiscard]] std::int32_t sine_of(std::uint32_t angle);

[[nodiscard]] Rotation rotation_of(std::uint32_t angle);

}  // namespace iog::numeric
