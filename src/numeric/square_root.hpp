// The square root of a whole number, rounded down, without a divide instruction.
//
// Bit by bit from the highest, as by hand: each bit of the root costs a comparison and a
// subtraction.
#pragma once

#include <bit>
#include <cstdint>

namespace iog::numeric {

// floor(sqrt(square))
[[nodiscard]] constexpr std::uint32_t square_root(std::uint64_t square) {
  std::uint64_t rest = square;
  std::uint64_t root = 0;
  // The highest power of four that is not above it.
  const int pairs = (static_cast<int>(std::bit_width(square)) - 1) / 2;
  std::uint64_t bit = square == 0 ? 0 : std::uint64_t{1} << 2 * pairs;
  while (bit != 0) {
    const bool is_set = rest >= root + bit;
    rest -= is_set ? root + bit : 0;
    root = (root >> 1) + (is_set ? bit : 0);
    bit >>= 2;
  }
  return static_cast<std::uint32_t>(root);
}

}  // namespace iog::numeric
