// Computes eight carry-less products at a time, as the Cortex-A9 does with a single instruction.
//
// This code is the reference. The NEON implementation is in checksum/crc32_neon.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::checksum {

inline constexpr std::size_t kProductLanes = 8;
inline constexpr std::size_t kFactorBytes = 4;

// A 32-bit factor for each of eight bytes. The factors are stored in the order in which the machine
// loads them: first the lowest byte of each factor, then the next byte of each, and so on.
struct alignas(32) Factors {
  std::array<std::array<std::uint8_t, kProductLanes>, kFactorBytes> bytes{};

  constexpr void set(std::size_t lane, std::uint32_t factor) {
    for (std::size_t i = 0; i < kFactorBytes; ++i) {
      bytes[i][lane] = static_cast<std::uint8_t>(factor >> (8 * i));
    }
  }
};

// Multiplies bytes by their factors and sums the products, both without carries. Each sum has
// 8 + 32 - 1 = 39 bits.
class PlainProducts {
 public:
  // The carry-less sums for the first and the second half of the data. Each group of factors is
  // applied to eight bytes of each half.
  struct Sums {
    std::uint64_t first = 0;
    std::uint64_t second = 0;
  };
  static Sums of_halves(const std::byte* first, const std::byte* second,
                        std::span<const Factors> factors) {
    Sums sums;
    for (const Factors& of_eight : factors) {
      sums.first ^= of(std::span<const std::byte, kProductLanes>(first, kProductLanes), of_eight);
      sums.second ^= of(std::span<const std::byte, kProductLanes>(second, kProductLanes), of_eight);
      first += kProductLanes;
      second += kProductLanes;
    }
    return sums;
  }

  static std::uint64_t of(std::span<const std::byte, kProductLanes> bytes, const Factors& factors) {
    std::uint64_t sum = 0;
    for (std::size_t lane = 0; lane < kProductLanes; ++lane) {
      for (std::size_t i = 0; i < kFactorBytes; ++i) {
        for (unsigned bit = 0; bit < 8; ++bit) {
          const std::uint64_t factor = factors.bytes[i][lane];
          const bool is_set = (std::to_integer<unsigned>(bytes[lane]) >> bit & 1U) != 0;
          sum ^= is_set ? factor << (8 * i + bit) : 0U;
        }
      }
    }
    return sum;
  }
};

}  // namespace iog::checksum
