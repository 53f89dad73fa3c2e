#include "authentication/aes128.hpp"

#include <bit>
#include <cstdint>

#include "wire/byte_order.hpp"

namespace iog::authentication {
namespace {

// x^8 = x^4 + x^3 + x + 1 in the field of AES.
constexpr unsigned kReduction = 0x1B;

constexpr void add(Planes& state, const Planes& other) {
  for (std::size_t bit = 0; bit < state.size(); ++bit) {
    state[bit] ^= other[bit];
  }
}

// FIPS 197, ShiftRows. A row is one byte of a plane. Row r rotates by r columns of two bits each.
constexpr void shift_rows(Planes& state) {
  for (std::uint32_t& plane : state) {
    plane = (plane & 0x000000FF) | (plane & 0x0000FC00) >> 2 | (plane & 0x00000300) << 6 |
            (plane & 0x00F00000) >> 4 | (plane & 0x000F0000) << 4 | (plane & 0xC0000000) >> 6 |
            (plane & 0x3F000000) << 2;
  }
}

// FIPS 197, MixColumns. For the rows a, b, c, d from top to bottom, the new first row is 2 (a + b)
// + b + c + d. Rotating a plane by one byte moves up the next row.
constexpr void mix_columns(Planes& state) {
  Planes sums{};  // a + b
  for (std::size_t bit = 0; bit < state.size(); ++bit) {
    sums[bit] = state[bit] ^ std::rotr(state[bit], 8);
  }
  for (std::size_t bit = 0; bit < state.size(); ++bit) {
    const std::uint32_t below = bit > 0 ? sums[bit - 1] : 0;
    const std::uint32_t reduced = (kReduction >> bit & 1U) != 0 ? sums[7] : 0;
    state[bit] = std::rotr(state[bit], 8) ^ std::rotr(sums[bit], 16) ^ below ^ reduced;
  }
}

// FIPS 197, SubWord.
std::uint32_t substituted(std::uint32_t column) {
  Planes planes = planes_of_column(column);
  substitute(planes);
  return column_of(planes);
}

}  // namespace

// FIPS 197, KeyExpansion. The lowest byte of a word is the first of its column.
Aes128::Aes128(const Key& key) {
  const std::span<const std::byte, kBlockBytes> bytes(key);
  std::array<std::uint32_t, 4> words{
      wire::load_le32(bytes.subspan<0, 4>()), wire::load_le32(bytes.subspan<4, 4>()),
      wire::load_le32(bytes.subspan<8, 4>()), wire::load_le32(bytes.subspan<12, 4>())};
  round_keys_[0] = planes_of(bytes);
  std::uint32_t constant = 1;
  for (std::size_t round = 1; round <= kRounds; ++round) {
    words[0] ^= substituted(std::rotr(words[3], 8)) ^ constant;
    words[1] ^= words[0];
    words[2] ^= words[1];
    words[3] ^= words[2];
    constant = constant << 1 ^ (constant >> 7) * (0x100 | kReduction);
    Block round_key{};
    const std::span<std::byte, kBlockBytes> out(round_key);
    wire::store_le32(out.subspan<0, 4>(), words[0]);
    wire::store_le32(out.subspan<4, 4>(), words[1]);
    wire::store_le32(out.subspan<8, 4>(), words[2]);
    wire::store_le32(out.subspan<12, 4>(), words[3]);
    round_keys_[round] = planes_of(out);
  }
}

Block Aes128::encrypt(std::span<const std::byte, kBlockBytes> block) const {
  Planes state = planes_of(block);
  add(state, round_keys_[0]);
  for (std::size_t round = 1; round < kRounds; ++round) {
    substitute(state);
    shift_rows(state);
    mix_columns(state);
    add(state, round_keys_[round]);
  }
  substitute(state);
  shift_rows(state);
  add(state, round_keys_[kRounds]);
  return block_of(state);
}

}  // namespace iog::authentication
