// The Internet checksum (RFC 1071) is the one's complement of the one's complement sum of 16-bit
// words.
//
// The carries can be added back at the end because 2^16 is congruent to 1 modulo `2^16 - 1`. The
// sum of `n` words is below `2^16 * n`, so 32 bits are enough for the sum of 2^16 words. No caller
// sums more than two datagrams, each with at most 2^15 words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::net {

// Sums several pieces as if they were contiguous in memory. A piece may have an odd number of
// bytes. If the data includes a correct checksum, value() returns 0.
class Checksum {
 public:
  void add(std::span<const std::byte> bytes);
  constexpr void add_u16(std::uint16_t word) { add_sum(word, 2); }
  constexpr void add_u32(std::uint32_t words) {
    add_u16(static_cast<std::uint16_t>(words >> 16));
    add_u16(static_cast<std::uint16_t>(words));
  }

  // Copies `bytes` to the front of `to` and adds them to the sum. `bytes` and `to` must not
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

  // The first addition yields at most `2^17 - 2`. If this sum has a carry, its lower half is at
  // most `2^16 - 2`, so the second addition yields at most `2^16 - 1`.
  static constexpr std::uint16_t fold(std::uint32_t sum) {
    const std::uint32_t once = (sum >> 16) + (sum & 0xFFFFU);
    return static_cast<std::uint16_t>((once >> 16) + (once & 0xFFFFU));
  }

  // If a piece is preceded by an odd number of bytes, the bytes in each of its words must be
  // swapped. The sum of byte-swapped words is the byte-swapped sum.
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
