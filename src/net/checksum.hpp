// The Internet checksum (RFC 1071): the complement of the one's complement sum of 16-bit words.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace iog::net {

// Sums bytes piece by piece, as if the pieces lay behind each other; any piece may be odd.
// Data that carries its own right checksum has the checksum 0.
class Checksum {
 public:
  void add(std::span<const std::byte> bytes);
  void add_u16(std::uint16_t word);
  void add_u32(std::uint32_t words);

  // What belongs into the checksum field when that field was summed as 0.
  [[nodiscard]] std::uint16_t value() const;

 private:
  void add_sum(std::uint16_t sum, std::size_t size);

  std::uint32_t sum_ = 0;  // of 16-bit words, kept below 2^16 by folding
  bool odd_ = false;       // an odd number of bytes lies before the next piece
};

[[nodiscard]] std::uint16_t internet_checksum(std::span<const std::byte> bytes);

}  // namespace iog::net
