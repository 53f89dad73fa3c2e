// How large a number is, whatever its sign.
#pragma once

#include <concepts>

namespace iog::numeric {

// value is not the least of its type.
template <std::signed_integral T>
constexpr T magnitude(T value) {
  return value < 0 ? -value : value;
}

}  // namespace iog::numeric
