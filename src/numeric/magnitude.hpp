// The absolute value of an integer.
#pragma once

#include <concepts>

namespace iog::numeric {

// `value` must not be the minimum of its type.
template <std::signed_integral T>
constexpr T magnitude(T value) {
  return value < 0 ? -value : value;
}

}  // namespace iog::numeric
