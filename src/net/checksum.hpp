// The Internet checksum (RFC 1071): the complement of the one's complement sum of 16-bit words.
//
// Ranges: 2^16 = 1 modulo 2^16 - 1, so carries may wait. A sum of n words is below 2^16 n; 32 bits
// hold 2^16 words, and nothing here sums more than two datagrams of 2^15.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::net {

// Sums bytes piece by piece, as if the pieces followed one another in memory. A piece may have an
// odd number of bytes. Data that contains its own correct checksum sums to the checksum 0.
class Checksum {
 public:
  void add(std::span<const std::byte> bytes);
  constexpr void add_u16(std::uint16_t word) { add_sum(word, 2); }
  constexpr void add_u32(std::uint32_t words) {
    add_u16(static_cast<std::uint16_t>(words >> 16));
    add_u16(static_cast<std::uint16_t>(words));
  }

  // Copies the bytes to the front of `to`, which does not overlap them, and sums them on the way.
  // `to` is written once, in order, and never read, so it may be uncached.
  void add_copied(std::span<const std::byte> bytes, std::span<std::byte> to);

  // The value for the checksum field, if that field was summed as 0.
  [[nodiscard]] constexpr std::uint16_t value() const {
    return static_cast<std::uint16_t>(~fold(sum_));
  }

 private:
  static constexpr std::uint16_t swapped(std::uint16_t word) {
    return static_cast<std::uint16_t>(word << 8 | word >> 8);
  }

  // The first addition leaves at most 2 (2^16 - 1), that is a carry of 1 and a lower half of at
  // most 2^16 - 2; so the second leaves at most 2^16 - 1.
  static constexpr std::uint16_t fold(std::uint32_t sum) {
    const std::uint32_t once = (sum >> 16) + (sum & 0xFFFFU);
    return static_cast<std::uint16_t>((once >> 16) + (once & 0xFFFFU));
  }

  // After an odd number of bytes, each byte of this piece belongs in the other half of its word.
  // The sum of swapped words is the swapped sum.
  constexpr void add_sum(std::uint16_t sum, std::size_t size) {
    sum_ += odd_ ? swapped(sum) : sum;
    odd_ ^= (size % 2 != 0);
  }
  void add_little_endian(std::uint32_t sum, std::size_t size);

  std::uint32_t sum_ = 0;  // of 16-bit words, carries included
  bool odd_ = false;       // an odd number of bytes lies before the next piece
};

[[nodiscard]] std::uint16_t internet_checksum(std::span<const std::byte> bytes);

}  // namespace iog::net
