// Arithmetic modulo the polynomial of a reflected CRC-32. Bit 31 is x^0 and bit 0 is x^31.
#pragma once

#include <cstddef>
#include <cstdint>

namespace iog::checksum {

// `kPolynomial` uses the notation of the standards, with the highest power first and x^32 omitted.
template <std::uint32_t kPolynomial>
class ReflectedField {
 public:
  static constexpr std::uint32_t times_x(std::uint32_t of) {
    return (of >> 1) ^ ((of & 1U) != 0 ? mirrored() : 0U);
  }

  static constexpr std::uint32_t times_x8(std::uint32_t of) {
    for (int bit = 0; bit < 8; ++bit) {
      of = times_x(of);
    }
    return of;
  }

  static constexpr std::uint32_t product(std::uint32_t one, std::uint32_t other) {
    std::uint32_t sum = 0;
    for (; one != 0; one <<= 1) {
      sum ^= (one & kOne) != 0 ? other : 0U;
      other = times_x(other);
    }
    return sum;
  }

  // Returns x^(8 * exponent). Multiplying a state by this value gives the state after `exponent`
  // zero bytes.
  static consteval std::uint32_t power_of_x8(std::size_t exponent) {
    std::uint32_t power = kOne;
    for (std::uint32_t square = times_x8(kOne); exponent != 0; exponent /= 2) {
      power = exponent % 2 != 0 ? product(power, square) : power;
      square = product(square, square);
    }
    return power;
  }

 private:
  static constexpr std::uint32_t kOne = 0x8000'0000U;

  static constexpr std::uint32_t mirrored() {
    std::uint32_t mirror = 0;
    std::uint32_t left = kPolynomial;
    for (int bit = 0; bit < 32; ++bit) {
      mirror = (mirror << 1) | (left & 1U);
      left >>= 1;
    }
    return mirror;
  }
};

}  // namespace iog::checksum
