#include "authentication/planes.hpp"

#include "wire/byte_order.hpp"

namespace iog::authentication {
namespace {

// Swaps the bits of b under `mask` with the bits of a that are `shift` higher.
constexpr void exchange(std::uint32_t& a, std::uint32_t& b, std::uint32_t mask, unsigned shift) {
  const std::uint32_t differ = ((a >> shift) ^ b) & mask;
  a ^= differ << shift;
  b ^= differ;
}

// Transposes an 8 x 8 bit matrix in each byte lane: bit j of word i becomes bit i of word j. Doing
// it twice restores the input.
constexpr void transpose(Planes& words) {
  for (std::size_t i = 0; i < 8; i += 2) {
    exchange(words[i], words[i + 1], 0x55555555, 1);
  }
  for (const std::size_t i : {0U, 1U, 4U, 5U}) {
    exchange(words[i], words[i + 2], 0x33333333, 2);
  }
  for (std::size_t i = 0; i < 4; ++i) {
    exchange(words[i], words[i + 4], 0x0F0F0F0F, 4);
  }
}

}  // namespace

Planes planes_of(std::span<const std::byte, kBlockBytes> block) {
  Planes words{
      wire::load_le32(block.subspan<0, 4>()), 0, wire::load_le32(block.subspan<4, 4>()),  0,
      wire::load_le32(block.subspan<8, 4>()), 0, wire::load_le32(block.subspan<12, 4>()), 0};
  transpose(words);
  return words;
}

Block block_of(const Planes& planes) {
  Planes words = planes;
  transpose(words);
  Block block{};
  const std::span<std::byte, kBlockBytes> bytes(block);
  wire::store_le32(bytes.subspan<0, 4>(), words[0]);
  wire::store_le32(bytes.subspan<4, 4>(), words[2]);
  wire::store_le32(bytes.subspan<8, 4>(), words[4]);
  wire::store_le32(bytes.subspan<12, 4>(), words[6]);
  return block;
}

Planes planes_of_column(std::uint32_t column) {
  Planes words{column};
  transpose(words);
  return words;
}

std::uint32_t column_of(const Planes& planes) {
  Planes words = planes;
  transpose(words);
  return words[0];
}

}  // namespace iog::authentication
