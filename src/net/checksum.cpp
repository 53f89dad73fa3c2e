// Ranges: a piece is summed as 32-bit words into 64 bits, so 2^32 words fit; a frame has 379.
// 2^16 = 1 modulo 2^16 - 1, and so is 2^32: folding the upper half onto the lower keeps the sum.
// Two folds bring 2n bits into n: the first leaves at most 2 * (2^n - 1), that is a carry of 1 and
// a lower half of at most 2^n - 2, so that the second leaves at most 2^n - 1.
#include "net/checksum.hpp"

#include "wire/byte_order.hpp"

namespace iog::net {
namespace {

constexpr std::uint16_t fold(std::uint64_t sum) {
  std::uint64_t folded = (sum >> 32) + (sum & 0xFFFF'FFFF);
  folded = (folded >> 32) + (folded & 0xFFFF'FFFF);
  folded = (folded >> 16) + (folded & 0xFFFF);
  folded = (folded >> 16) + (folded & 0xFFFF);
  return static_cast<std::uint16_t>(folded);
}

constexpr std::uint16_t swapped(std::uint16_t word) {
  return static_cast<std::uint16_t>(word << 8 | word >> 8);
}

// The words are read little-endian, which costs no instruction on our machines, and only the sum is
// swapped: RFC 1071, section 2 (B). A tail of 1 to 3 bytes counts as padded with zeros.
std::uint16_t ones_complement_sum(std::span<const std::byte> bytes) {
  std::uint64_t sum = 0;
  while (bytes.size() >= 4) {
    sum += wire::load_le32(bytes.first<4>());
    bytes = bytes.subspan(4);
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    sum += std::to_integer<std::uint32_t>(bytes[i]) << (8 * i);
  }
  return swapped(fold(sum));
}

}  // namespace

void Checksum::add(std::span<const std::byte> bytes) {
  add_sum(ones_complement_sum(bytes), bytes.size());
}

void Checksum::add_u16(std::uint16_t word) { add_sum(word, 2); }

void Checksum::add_u32(std::uint32_t words) { add_sum(fold(words), 4); }

std::uint16_t Checksum::value() const { return static_cast<std::uint16_t>(~sum_); }

// Behind an odd number of bytes each byte of the piece sits in the other half of its word, and the
// sum of swapped words is the swapped sum.
void Checksum::add_sum(std::uint16_t sum, std::size_t size) {
  sum_ = fold(std::uint64_t{sum_} + (odd_ ? swapped(sum) : sum));
  odd_ ^= (size % 2 != 0);
}

std::uint16_t internet_checksum(std::span<const std::byte> bytes) {
  Checksum checksum;
  checksum.add(bytes);
  return checksum.value();
}

}  // namespace iog::net
