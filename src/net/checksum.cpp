// Words are read little-endian, which is free on our machines, and only the sum is byte-swapped
// (RFC 1071, section 2 (B)). The loops are written so that the compiler vectorises them in steps of
// 16 bytes.
#include "net/checksum.hpp"

#include <array>

#include "wire/byte_order.hpp"

namespace iog::net {
namespace {

constexpr std::size_t kWordBytes = 2;

std::uint32_t word_at(const std::byte* bytes) {
  return wire::load_le16(std::span<const std::byte, kWordBytes>(bytes, kWordBytes));
}

// Copies `words` 16-bit words and returns their sum.
std::uint32_t copy_words(const std::byte* __restrict in, std::byte* __restrict out,
                         std::size_t words) {
  std::uint32_t sum = 0;
  for (; words > 0; --words, in += kWordBytes, out += kWordBytes) {
    std::array<std::byte, kWordBytes> word{};
    __builtin_memcpy(word.data(), in, kWordBytes);
    __builtin_memcpy(out, word.data(), kWordBytes);
    sum += word_at(word.data());
  }
  return sum;
}

}  // namespace

void Checksum::add(std::span<const std::byte> bytes) {
  std::uint32_t sum = 0;
  const std::byte* from = bytes.data();
  for (std::size_t words = bytes.size() / kWordBytes; words > 0; --words, from += kWordBytes) {
    sum += word_at(from);
  }
  if (bytes.size() % kWordBytes != 0) {
    sum += std::to_integer<std::uint32_t>(bytes.back());
  }
  add_little_endian(sum, bytes.size());
}

void Checksum::add_copied(std::span<const std::byte> bytes, std::span<std::byte> to) {
  std::uint32_t sum = copy_words(bytes.data(), to.data(), bytes.size() / kWordBytes);
  if (bytes.size() % kWordBytes != 0) {
    to[bytes.size() - 1] = bytes.back();
    sum += std::to_integer<std::uint32_t>(bytes.back());
  }
  add_little_endian(sum, bytes.size());
}

void Checksum::add_little_endian(std::uint32_t sum, std::size_t size) {
  add_sum(swapped(fold(sum)), size);
}

std::uint16_t internet_checksum(std::span<const std::byte> bytes) {
  Checksum checksum;
  checksum.add(bytes);
  return checksum.value();
}

}  // namespace iog::net
