// Packs symbols into large numbers. Each symbol has n possible values (alternatives).
//
// A symbol contains log2(n) bits of information, which is rarely a whole number. Several symbols
// are therefore combined as the digits of one number in base n, with the most significant digit
// first. The number of combined symbols is the largest multiple of four that fits. Each number is
// stored in as many bits as its largest possible value requires. The last number of a tile contains
// the remaining symbols, padded with zeros to a multiple of four. It takes no more bits than its
// groups of four symbols would take separately.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

namespace iog::tile_coding {

// The maximum number of bits that BitWriter accepts in one call.
inline constexpr unsigned kMostNumberBits = 31;

// The largest base in which a four-digit number fits in kMostNumberBits bits.
inline constexpr std::uint32_t kMostAlternatives = 215;

struct Packing {
  std::uint8_t fours = 0;  // groups of four digits in a number
  std::uint8_t bits = 0;   // bits of a number
  std::uint8_t bits_of_four = 0;

  // Returns how many bits the last number of a tile takes if it contains `of_fours` groups of four
  // symbols.
  [[nodiscard]] constexpr std::uint32_t rest_bits(std::size_t of_fours) const {
    return std::min<std::uint32_t>(bits, static_cast<std::uint32_t>(of_fours) * bits_of_four);
  }
};

// The table is indexed by the number of alternatives. If there is only one alternative, a symbol
// contains no information and takes no bits.
inline constexpr std::size_t kPackingCount = 216;
static_assert(kPackingCount == kMostAlternatives + 1);

using Packings = std::array<Packing, kPackingCount>;

consteval Packings make_packings() {
  Packings packings{};
  for (std::size_t n = 2; n <= kMostAlternatives; ++n) {
    const std::uint64_t of_four = std::uint64_t{n} * n * n * n;
    const auto bits_of = [](std::uint64_t numbers) {
      return static_cast<std::uint8_t>(std::bit_width(numbers - 1));
    };
    std::uint64_t numbers = 1;
    std::uint8_t fours = 0;
    for (; bits_of(numbers * of_four) <= kMostNumberBits; ++fours) {
      numbers *= of_four;
    }
    packings[n] = {.fours = fours, .bits = bits_of(numbers), .bits_of_four = bits_of(of_four)};
  }
  return packings;
}
inline constexpr Packings kPackings = make_packings();
static_assert(kPackings[5].fours == 3 && kPackings[5].bits == 28);  // 5^12 < 2^28
static_assert(kPackings[kMostAlternatives].fours == 1);

}  // namespace iog::tile_coding
