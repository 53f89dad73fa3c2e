#include "authentication/sha256.hpp"

#include <algorithm>
#include <bit>
#include <cstdint>

#include "wire/byte_order.hpp"

namespace iog::authentication {
namespace {

constexpr std::size_t kBlock = 64;
constexpr std::size_t kRounds = 64;
using State = std::array<std::uint32_t, 8>;

// FIPS 180-4, 4.2.2: the first 32 bits of the fractional parts of the cube roots of the first 64
// primes.
constexpr std::array<std::uint32_t, kRounds> kConstants{
    0x428A2F98, 0x71374491, 0xB5C0FBCF, 0xE9B5DBA5, 0x3956C25B, 0x59F111F1, 0x923F82A4, 0xAB1C5ED5,
    0xD807AA98, 0x12835B01, 0x243185BE, 0x550C7DC3, 0x72BE5D74, 0x80DEB1FE, 0x9BDC06A7, 0xC19BF174,
    0xE49B69C1, 0xEFBE4786, 0x0FC19DC6, 0x240CA1CC, 0x2DE92C6F, 0x4A7484AA, 0x5CB0A9DC, 0x76F988DA,
    0x983E5152, 0xA831C66D, 0xB00327C8, 0xBF597FC7, 0xC6E00BF3, 0xD5A79147, 0x06CA6351, 0x14292967,
    0x27B70A85, 0x2E1B2138, 0x4D2C6DFC, 0x53380D13, 0x650A7354, 0x766A0ABB, 0x81C2C92E, 0x92722C85,
    0xA2BFE8A1, 0xA81A664B, 0xC24B8B70, 0xC76C51A3, 0xD192E819, 0xD6990624, 0xF40E3585, 0x106AA070,
    0x19A4C116, 0x1E376C08, 0x2748774C, 0x34B0BCB5, 0x391C0CB3, 0x4ED8AA4A, 0x5B9CCA4F, 0x682E6FF3,
    0x748F82EE, 0x78A5636F, 0x84C87814, 0x8CC70208, 0x90BEFFFA, 0xA4506CEB, 0xBEF9A3F7, 0xC67178F2};

// 5.3.3: the same bits of the square roots of the first 8 primes.
constexpr State kStart{0x6A09E667, 0xBB67AE85, 0x3C6EF372, 0xA54FF53A,
                       0x510E527F, 0x9B05688C, 0x1F83D9AB, 0x5BE0CD19};

// 6.2.2, one round. The caller rotates the arguments instead of moving all eight words.
void round(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t& d, std::uint32_t e,
           std::uint32_t f, std::uint32_t g, std::uint32_t& h, std::uint32_t constant_and_word) {
  const std::uint32_t sum_e = std::rotr(e, 6) ^ std::rotr(e, 11) ^ std::rotr(e, 25);
  const std::uint32_t sum_a = std::rotr(a, 2) ^ std::rotr(a, 13) ^ std::rotr(a, 22);
  h += sum_e + (g ^ (e & (f ^ g))) + constant_and_word;
  d += h;
  h += sum_a + ((a & b) | (c & (a | b)));
}

void absorb(std::span<const std::byte, kBlock> block, State& state) {
  std::array<std::uint32_t, kRounds> words;
  for (std::size_t i = 0; i < 16; ++i) {
    words[i] = wire::load_be32(block.subspan(4 * i).first<4>());
  }
  for (std::size_t i = 16; i < kRounds; ++i) {
    const std::uint32_t w2 = words[i - 2];
    const std::uint32_t w15 = words[i - 15];
    words[i] = (std::rotr(w2, 17) ^ std::rotr(w2, 19) ^ w2 >> 10) + words[i - 7] +
               (std::rotr(w15, 7) ^ std::rotr(w15, 18) ^ w15 >> 3) + words[i - 16];
  }
  auto [a, b, c, d, e, f, g, h] = state;
  for (std::size_t i = 0; i < kRounds; i += 8) {
    const auto next = [&](std::size_t of) { return kConstants[i + of] + words[i + of]; };
    round(a, b, c, d, e, f, g, h, next(0));
    round(h, a, b, c, d, e, f, g, next(1));
    round(g, h, a, b, c, d, e, f, next(2));
    round(f, g, h, a, b, c, d, e, next(3));
    round(e, f, g, h, a, b, c, d, next(4));
    round(d, e, f, g, h, a, b, c, next(5));
    round(c, d, e, f, g, h, a, b, next(6));
    round(b, c, d, e, f, g, h, a, next(7));
  }
  const State after{a, b, c, d, e, f, g, h};
  for (std::size_t i = 0; i < state.size(); ++i) {
    state[i] += after[i];
  }
}

}  // namespace

std::array<std::byte, kSha256Bytes> sha256(std::span<const std::byte> message) {
  State state = kStart;
  std::span<const std::byte> rest = message;
  for (; rest.size() >= kBlock; rest = rest.subspan(kBlock)) {
    absorb(rest.first<kBlock>(), state);
  }
  // 5.1.1: a one bit, zeros and the length in bits, padded to whole blocks.
  std::array<std::byte, 2 * kBlock> tail{};
  std::ranges::copy(rest, tail.begin());
  tail[rest.size()] = std::byte{0x80};
  const std::size_t blocks = rest.size() < kBlock - 8 ? 1 : 2;
  wire::store_be32(std::span(tail).subspan(blocks * kBlock - 4).first<4>(),
                   static_cast<std::uint32_t>(message.size() * 8));
  absorb(std::span(tail).first<kBlock>(), state);
  if (blocks == 2) {
    absorb(std::span(tail).last<kBlock>(), state);
  }
  std::array<std::byte, kSha256Bytes> hash;
  for (std::size_t i = 0; i < state.size(); ++i) {
    wire::store_be32(std::span(hash).subspan(4 * i).first<4>(), state[i]);
  }
  return hash;
}

}  // namespace iog::authentication
