// Reads IEEE 754 binary32 numbers without floating-point arithmetic.
//
// A binary32 number equals m * 2^(e - 150) with m below 2^24. The product of m and a factor below
// 2^32 is below 2^56. One 64-bit multiplication and one shift therefore give an exact result.
#pragma once

#include <cstdint>
#include <optional>

namespace iog::wire {

// Returns the integer nearest to value * factor / 2^fraction_bits, with ties rounded away from 0.
// `bits` is the encoded value. `fraction_bits` is in the range 0 to 32. Returns nothing if the
// value is NaN, infinite, or at least 2^(19 + fraction_bits).
[[nodiscard]] constexpr std::optional<std::int64_t> nearest_product(std::uint32_t bits,
                                                                    std::uint32_t factor,
                                                                    int fraction_bits) {
  constexpr std::uint32_t kHidden = std::uint32_t{1} << 23;
  const auto exponent = static_cast<int>(bits >> 23 & 0xFFU);
  const int shift = fraction_bits + 150 - (exponent == 0 ? 1 : exponent);
  if (exponent == 0xFF || shift < 4) {
    return std::nullopt;
  }
  if (shift > 57) {
    return 0;  // below one quarter
  }
  const std::uint32_t mantissa = (bits & (kHidden - 1)) | (exponent == 0 ? 0 : kHidden);
  const std::uint64_t product = std::uint64_t{mantissa} * factor;
  const auto size =
      static_cast<std::int64_t>((product + (std::uint64_t{1} << (shift - 1))) >> shift);
  return (bits >> 31) != 0 ? -size : size;
}

}  // namespace iog::wire
