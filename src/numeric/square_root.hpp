// Computes the square root of an integer, rounded down, without a divide instruction.
//
// The root is computed bit by bit, starting with the highest bit. Each bit requires one comparison
// and one subtraction. If the argument fits into 32 bits, both operations use 32-bit words.
#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <limits>

namespace iog::numeric {

namespace detail {

template <std::unsigned_integral Word>
[[nodiscard]] constexpr std::uint32_t square_root(Word square) {
  Word rest = square;
  Word root = 0;
  // The highest power of four that does not exceed `square`.
  const int pairs = (static_cast<int>(std::bit_width(square)) - 1) / 2;
  Word bit = square == 0 ? 0 : Word{1} << 2 * pairs;
  while (bit != 0) {
    const bool is_set = rest >= root + bit;
    rest -= is_set ? root + bit : 0;
    root = (root >> 1) + (is_set ? bit : 0);
    bit >>= 2;
  }
  return static_cast<std::uint32_t>(root);
}

}  // namespace detail

// Returns floor(sqrt(square)).
[[nodiscard]] constexpr std::uint32_t square_root(std::uint64_t square) {
  return square <= std::numeric_limits<std::uint32_t>::max()
             ? detail::square_root(static_cast<std::uint32_t>(square))
             : detail::square_root(square);
}

}  // namespace iog::numeric
