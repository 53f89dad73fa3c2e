// Carry-less products of bytes, eight at a time: what the Cortex-A9 multiplies in one instruction.
//
// This is the specification; its twin for NEON is in checksum/crc32_neon.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::checksum {

inline constexpr std::size_t kProductLanes = 8;
inline constexpr std::size_t kFactorBytes = 4;

// A factor of 32 bits for each of eight bytes, as the machine loads them: byte by byte, lowest
// first.
struct alignas(16) Factors {
  std::array<std::array<std::uint8_t, kProductLanes>, kFactorBytes> bytes{};

  constexpr void set(std::size_t lane, std::uint32_t factor) {
    for (std::size_t i = 0; i < kFactorBytes; ++i) {
      bytes[i][lane] = static_cast<std::uint8_t>(factor >> (8 * i));
    }
  }
};

// The sum, without carry, of bytes times their factors: 8 + 32 - 1 = 39 bits.
class PlainProducts {
 public:
  void add(std::span<const std::byte, kProductLanes> bytes, const Factors& factors) {
    for (std::size_t lane = 0; lane < kProductLanes; ++lane) {
      for (std::size_t i = 0; i < kFactorBytes; ++i) {
        for (unsigned bit = 0; bit < 8; ++bit) {
          const std::uint64_t factor = factors.bytes[i][lane];
          const bool is_set = (std::to_integer<unsigned>(bytes[lane]) >> bit & 1U) != 0;
          sum_ ^= is_set ? factor << (8 * i + bit) : 0U;
        }
      }
    }
  }

  [[nodiscard]] std::uint64_t sum() const { return sum_; }

 private:
  std::uint64_t sum_ = 0;
};

}  // namespace iog::checksum
