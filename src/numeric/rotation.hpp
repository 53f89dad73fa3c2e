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

struct Rotation {
  std::int32_t cos_q30 = 1 << kSineFractionBits;
  std::int32_t sin_q30 = 0;
};

// sine of angle / 2^32 turns, -2^30 ... 2^30. A step of the table is below 2^21 and a fraction
// below 2^20, so the product is below 2^41.
constexpr std::int32_t sine_of(std::uint32_t angle) {
  constexpr int kTickBits = 12;
  constexpr int kFractionBits = 32 - kTickBits;
  constexpr SineTable kTable = kSineTable<1 << kTickBits>;
  const std::uint32_t tick = angle >> kFractionBits;
  const std::int64_t fraction = angle % (1U << kFractionBits);
  const std::int32_t here = kTable.sine(tick);
  const std::int32_t step = kTable.sine((tick + 1) % (1U << kTickBits)) - here;
  const std::int64_t risen = (step * fraction + (1 << (kFractionBits - 1))) >> kFractionBits;
  return here + static_cast<std::int32_t>(risen);
}

constexpr std::int32_t cosine_of(std::uint32_t angle) { return sine_of(angle + (1U << 30)); }

constexpr Rotation rotation_of(std::uint32_t angle) {
  return {.cos_q30 = cosine_of(angle), .sin_q30 = sine_of(angle)};
}

}  // namespace iog::numeric
