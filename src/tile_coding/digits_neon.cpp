// The Cortex-A9 twin of digits.cpp: sixteen symbols at a time.
#include <arm_neon.h>

#include "tile_coding/digits.hpp"

namespace iog::tile_coding {
namespace {

// Factors that combine digits into two-digit numbers, and these into four-digit numbers.
struct Weights {
  uint8x8_t of_digits;
  uint16x4_t of_pairs;
};

Weights weights_to(std::uint32_t base) {
  return {.of_digits = vreinterpret_u8_u16(vdup_n_u16(static_cast<std::uint16_t>(base | 1U << 8))),
          .of_pairs = vreinterpret_u16_u32(vdup_n_u32(base * base | 1U << 16))};
}

uint16x4_t pairs_of(uint8x8_t digits, const Weights& weights) {
  const uint16x8_t weighted = vmull_u8(digits, weights.of_digits);
  return vpadd_u16(vget_low_u16(weighted), vget_high_u16(weighted));
}

uint32x2_t numbers_of(uint8x8_t digits, const Weights& weights) {
  const uint32x4_t weighted = vmull_u16(pairs_of(digits, weights), weights.of_pairs);
  return vpadd_u32(vget_low_u32(weighted), vget_high_u32(weighted));
}

}  // namespace

void make_numbers(std::span<std::uint32_t> fours, std::uint32_t alternatives) {
  const Weights weights = weights_to(alternatives);
  const uint8x16_t lowest = vdupq_n_u8(kLowestSymbol);
  uint8x16_t last = lowest;
  std::uint32_t* next = fours.data();
  for (const std::uint32_t* const end = next + fours.size(); next < end; next += 4) {
    const uint8x16_t symbols = vreinterpretq_u8_u32(vld1q_u32(next));
    const uint8x16_t is_above = vcgtq_u8(symbols, vextq_u8(last, symbols, 15));  // -1 if above
    const uint8x16_t digits = vaddq_u8(vsubq_u8(symbols, lowest), is_above);
    vst1q_u32(next, vcombine_u32(numbers_of(vget_low_u8(digits), weights),
                                 numbers_of(vget_high_u8(digits), weights)));
    last = symbols;
  }
}

}  // namespace iog::tile_coding
