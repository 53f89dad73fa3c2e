// Implements checksum/crc32.hpp on machines that can perform carry-less multiplication of bytes.
//
// A CRC is linear. If a byte is followed by d other bytes, it contributes the product of the byte
// and x^(32 + 8 * d), modulo the polynomial. The contributions of the bytes in a block are
// therefore independent of each other. The products of all bytes are summed, and only the sum is
// reduced. Both halves of a block use the same factors, so each factor is loaded only once. The sum
// for the first half is not reduced either: its bytes are multiplied and added to the other sum.
//
// All polynomials are bit-reflected. Bit 0 of a state is x^31 and bit 0 of a byte is x^7, so bit 0
// of the product of a state and a byte is x^38.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

#include "checksum/products.hpp"
#include "checksum/reflected_crc32.hpp"
#include "checksum/reflected_field.hpp"
#include "wire/byte_order.hpp"

namespace iog::checksum {

// `Products` is either PlainProducts or the NEON implementation.
template <std::uint32_t kPolynomial, typename Products>
class ProductCrc32 {
 public:
  void update(std::span<const std::byte> bytes) {
    while (bytes.size() >= kLeastBlockBytes) {
      const std::size_t block = std::min(bytes.size() & ~(2 * kProductLanes - 1), kMostBlockBytes);
      rest_.set_state(after_block(rest_.state(), bytes.first(block)));
      bytes = bytes.subspan(block);
    }
    rest_.update(bytes);
  }

  // Returns the CRC of all bytes so far. Further calls to update() are allowed.
  [[nodiscard]] std::uint32_t value() const { return rest_.value(); }

  // Returns the state after `kBytes + more` zero bytes. Requires kBytes >= 8 and more <= kMost.
  template <std::size_t kBytes, std::size_t kMost = 0>
  static std::uint32_t after_zeros(std::uint32_t state, std::size_t more = 0) {
    static constexpr auto kFirst = make_first<kBytes>(std::make_index_sequence<kMost + 1>());
    return reduced(Products::of(state, kFirst[more]));
  }

  // Returns the state after `before`, which has kProductLanes to kMostBefore bytes, and kBytes zero
  // bytes. The odd leading bytes fill the end of a group of their own. If they are fewer than four,
  // the state continues in the next group.
  template <std::size_t kBytes, std::size_t kMostBefore>
  static std::uint32_t after_zeros(std::uint32_t state, std::span<const std::byte> before) {
    static constexpr auto kFactors = make_factors<kBytes, kMostBefore / kProductLanes + 1>();
    const std::size_t odd = before.size() % kProductLanes;
    const auto factors = std::span(kFactors).last(before.size() / kProductLanes + 1);
    const std::uint64_t eight = wire::load_le64(before.first<kProductLanes>()) ^ state;
    std::uint64_t sum = Products::of_all((eight << 8) << (8 * (kProductLanes - 1 - odd)),
                                         before.data() + odd, factors);
    if (odd < sizeof state) {
      sum ^= Products::of(state >> (8 * odd), factors[1]);
    }
    return reduced(sum);
  }

  // See ReflectedCrc32.
  [[nodiscard]] std::uint32_t state() const { return rest_.state(); }
  void set_state(std::uint32_t state) { rest_.set_state(state); }

 private:
  using Bytewise = ReflectedCrc32<kPolynomial, 1>;
  using Field = ReflectedField<kPolynomial>;

  static constexpr std::size_t kMostBlockBytes = 1408;  // a whole message
  static constexpr std::size_t kLeastBlockBytes = 2 * kProductLanes;
  static constexpr std::size_t kGroups = kMostBlockBytes / (2 * kProductLanes);
  using FactorsOfHalf = std::array<Factors, kGroups>;

  // Adding a state to the first four bytes of a block is equivalent to starting the block with this
  // state.
  static std::uint32_t after_block(std::uint32_t state, std::span<const std::byte> block) {
    const std::size_t half = block.size() / 2;
    const std::size_t groups = half / kProductLanes;
    const auto factors = std::span(kFactors).last(groups);
    return reduced(Products::of_halves(state, block.data(), block.data() + half, factors,
                                       kJoins[kGroups - groups]));
  }

  // Bits 0 to 6 of the sum are x^38 to x^32. A table lookup reduces these bits as if they were the
  // first byte of a state followed by a zero byte.
  static std::uint32_t reduced(std::uint64_t sum) {
    return Bytewise::after_byte(static_cast<std::uint32_t>(sum << 1) & 0xFFU) ^
           static_cast<std::uint32_t>(sum >> 7);
  }

  // The factor of a byte that is followed by d bytes is x^(32 + 8 * d). The last byte of the last
  // group is followed by kBytes bytes.
  template <std::size_t kBytes, std::size_t kCount>
  static constexpr std::array<Factors, kCount> make_factors() {
    std::array<Factors, kCount> factors{};
    std::uint32_t factor = Field::power_of_x8(kBytes + sizeof(std::uint32_t));
    for (std::size_t i = kCount * kProductLanes; i > 0; --i) {
      factors[(i - 1) / kProductLanes].set((i - 1) % kProductLanes, factor);
      factor = Field::times_x8(factor);
    }
    return factors;
  }

  // Computes the factors that join two halves, for each length of a half, the longest first. Bit j
  // of byte k of a sum is x^(38 - 8 * k - j), so a second half of h bytes multiplies this byte by
  // x^(8 * h + 31 - 8 * k).
  static constexpr FactorsOfHalf make_joins() {
    FactorsOfHalf joins{};
    constexpr std::uint32_t kX7 = 0x0100'0000U;
    std::uint32_t factor = Field::product(kX7, Field::power_of_x8(kProductLanes - 1));
    for (std::size_t i = kGroups; i > 0; --i) {
      for (std::size_t lane = kProductLanes; lane > 0; --lane) {
        joins[i - 1].set(lane - 1, factor);
        factor = lane % 2 == 0 ? Field::times_x8(factor) : factor;
      }
      for (std::size_t byte = kProductLanes / 2; byte > 0; --byte) {
        factor = Field::times_x8(factor);
      }
    }
    return joins;
  }

  // Computes the factors of the first eight bytes of a part, for each part length `kBytes + kMore`.
  template <std::size_t kBytes, std::size_t... kMore>
  static consteval auto make_first(std::index_sequence<kMore...> /*more*/) {
    std::array<Factors, sizeof...(kMore)> first{};
    for (std::size_t lane = 0; lane < kProductLanes; ++lane) {
      constexpr std::size_t kState = sizeof(std::uint32_t) - 1;
      (first[kMore].set(lane, Field::power_of_x8(kBytes + kMore - lane + kState)), ...);
    }
    return first;
  }

  static const FactorsOfHalf kFactors;
  static const FactorsOfHalf kJoins;

  Bytewise rest_;
};

template <std::uint32_t kPolynomial, typename Products>
inline constexpr typename ProductCrc32<kPolynomial, Products>::FactorsOfHalf
    ProductCrc32<kPolynomial, Products>::kFactors =
        ProductCrc32<kPolynomial, Products>::template make_factors<0, kGroups>();

template <std::uint32_t kPolynomial, typename Products>
inline constexpr typename ProductCrc32<kPolynomial, Products>::FactorsOfHalf
    ProductCrc32<kPolynomial, Products>::kJoins = ProductCrc32<kPolynomial, Products>::make_joins();

}  // namespace iog::checksum
