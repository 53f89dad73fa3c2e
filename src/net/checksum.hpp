// The Internet checksum (RFC 1071) is the one's complement of the one's complement sum of 16-bit
// words.
//
// The carries can be added back at the end because 2^16 = 1 modulo 2^16 - 1. A sum of n words is
// below 2^16 * n, so a 32-bit sum can hold 2^16 words. No caller sums more than two datagrams of
// 2^15 words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::net {

// Sums several pieces as if they were contiguous in memory. Each piece may have an odd number of
// bytes. If the data contains its own correct checksum, its sum is 0.
class Checksum {
 public:
  void add(std::span<const std::byte> bytes);
  constexpr void add_u16(std::uint16_t word) { add_sum(word, 2); }
  constexpr void add_u32(std::uint32_t words) {
    add_u16(static_cast<std::uint16_t>(words >> 16));
    add_u16(static_cast<std::uint16_t>(words));
  }

  // Copies `bytes` to the front of `to`, and adds them to the sum. `bytes` and `to` must not
  // overlap. Each byte of `to` is written exactly once, in order, and is never read, so `to` may be
  // uncached memory.
  void add_copied(std::span<const std::byte> bytes, std::span<std::byte> to);

  // Returns the value for the checksum field. That field must have been 0 when the sum was
  // computed.
  [[nodiscard]] constexpr std::uint16_t value() const {
    return static_cast<std::uint16_t>(~fold(sum_));
  }

 private:
  static constexpr std::uint16_t swapped(std::uint16_t word) {
    return static_cast<std::uint16_t>(word << 8 | word >> 8);
  }

  // The first addition leaves at most 2 * (2^16 - 1), which consists of a carry of 1 and a lower
  // half of at most 2^16 - 2. The second addition therefore leaves at most 2^16 - 1.
  static constexpr std::uint16_t fold(std::uint32_t sum) {
    const std::uint32_t once = (sum >> 16) + (sum & 0xFFFFU);
    return static_cast<std::uint16_t>((once >> 16) + (once & 0xFFFFU));
  }

  // After an odd number of bytes, each byte of the next piece belongs to the other half of its
  // 16-bit word. The sum of byte-swapped words is the byte-swapped sum.
  constexpr void add_sum(std::uint16_t sum, std::size_t size) {
    sum_ += odd_ ? swapped(sum) : sum;
    odd_ ^= (size % 2 != 0);
  }
  void add_little_endian(std::uint32_t sum, std::size_t size);

  std::uint32_t sum_ = 0;  // sum of 16-bit words, including carries
  bool odd_ = false;       // an odd number of bytes precedes the next piece
};

[[nodiscard]] std::uint16_t internet_checksum(std::span<const std::byte> bytes);

}  // namespace iog::net
