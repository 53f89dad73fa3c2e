// Computes eight carry-less products at a time, as the Cortex-A9 does with a single instruction.
//
// This code is the reference. The NEON implementation is in checksum/crc32_neon.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "wire/byte_order.hpp"

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
  // Returns the sum for two halves with the same factors. `state` is added to the first four bytes
  // of the first half. The sum for the first half is multiplied by `join` and added to the sum for
  // the second half. Bytes 0 to 4 of the first sum take the factors of the lanes 0, 1, 3, 5 and 7
  // of `join`, because the factors of the lanes 2, 4 and 6 repeat those before them.
  static std::uint64_t of_halves(std::uint32_t state, const std::byte* first,
                                 const std::byte* second, std::span<const Factors> factors,
                                 const Factors& join) {
    const std::uint64_t sum = of(state, factors.front()) ^ of_groups(first, factors);
    std::uint64_t spread = sum & 0xFFU;
    for (std::size_t i = 1; i <= kFactorBytes; ++i) {
      spread |= (sum >> (8 * i) & 0xFFU) << (8 * (2 * i - 1));
    }
    return of(spread, join) ^ of_groups(second, factors);
  }

  // Returns the sum for `eight`, which takes the first factors, and for one group of eight bytes
  // for each of the other factors.
  static std::uint64_t of_all(std::uint64_t eight, const std::byte* bytes,
                              std::span<const Factors> factors) {
    return of(eight, factors.front()) ^ of_groups(bytes, factors.subspan(1));
  }

  // Returns the sum for eight bytes, of which the lowest is that of lane 0.
  static std::uint64_t of(std::uint64_t bytes, const Factors& factors) {
    std::uint64_t sum = 0;
    for (std::size_t lane = 0; lane < kProductLanes; ++lane) {
      for (std::size_t i = 0; i < kFactorBytes; ++i) {
        for (unsigned bit = 0; bit < 8; ++bit) {
          const std::uint64_t factor = factors.bytes[i][lane];
          const bool is_set = (bytes >> (8 * lane + bit) & 1U) != 0;
          sum ^= is_set ? factor << (8 * i + bit) : 0U;
        }
      }
    }
    return sum;
  }

 private:
  static std::uint64_t of_groups(const std::byte* bytes, std::span<const Factors> factors) {
    std::uint64_t sum = 0;
    for (const Factors& of_eight : factors) {
      sum ^= of(wire::load_le64(std::span<const std::byte, kProductLanes>(bytes, kProductLanes)),
                of_eight);
      bytes += kProductLanes;
    }
    return sum;
  }
};

}  // namespace iog::checksum
