// Integer division functions, named after their rounding mode.
#pragma once

#include <concepts>

namespace iog::numeric {

// Returns the largest integer `q` with `q * divisor <= dividend`. Requires divisor > 0.
template <std::signed_integral T>
constexpr T div_floor(T dividend, T divisor) {
  const T quotient = dividend / divisor;
  return (dividend % divisor != 0 && dividend < 0) ? quotient - 1 : quotient;
}

// Returns the integer nearest to `dividend / divisor`. Ties are rounded towards plus infinity.
// Requires divisor > 0. The sum `|dividend| + divisor / 2` must fit in `T`.
template <std::signed_integral T>
constexpr T div_nearest(T dividend, T divisor) {
  return div_floor<T>(dividend + divisor / 2, divisor);
}

}  // namespace iog::numeric
