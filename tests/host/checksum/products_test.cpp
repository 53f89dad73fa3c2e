// Sums of carry-less products, and the CRC made of them.
#include "checksum/products.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "checksum/crc32.hpp"
#include "checksum/product_crc32.hpp"
#include "checksum/reflected_crc32.hpp"
#include "fakes/random.hpp"

namespace iog::checksum {
namespace {

// Eight bytes of which one lane is not zero.
std::uint64_t in_lane(std::size_t lane, std::uint64_t byte) { return byte << (8 * lane); }

// By hand: (x + 1)(x^2 + 1) = x^3 + x^2 + x + 1, and nothing is carried; sums of equals vanish.
TEST(Products, AreThoseOfPolynomials) {
  Factors factors;
  factors.set(2, 0b101);
  EXPECT_EQ(PlainProducts::of(in_lane(2, 0b11), factors), 0b1111U);
  factors.set(2, 0x8000'0001);
  EXPECT_EQ(PlainProducts::of(in_lane(2, 0x80), factors), 0x40'0000'0080U);
  factors.set(5, 0x8000'0001);
  EXPECT_EQ(PlainProducts::of(in_lane(2, 0x80) | in_lane(5, 0x80), factors), 0U);
}

// Both halves take the factors in order: lane 2 of the second eight bytes has its own. The first
// half's sum, 0b0111 in byte 0, is joined by the factor of lane 0.
TEST(Products, OfHalvesShareTheFactors) {
  std::array<Factors, 2> factors;
  factors[0].set(2, 0b101);
  factors[1].set(2, 0b10);
  std::array<std::byte, 4 * kProductLanes> bytes{};
  bytes[2] = std::byte{0b11};
  bytes[kProductLanes + 2] = std::byte{0b100};
  bytes[2 * kProductLanes + 2] = std::byte{0b1};
  Factors join;
  const auto sum = [&](std::uint32_t state) {
    return PlainProducts::of_halves(state, bytes.data(), bytes.data() + 2 * kProductLanes, factors,
                                    join);
  };
  EXPECT_EQ(sum(0), 0b101U);
  join.set(0, 0b1000);
  EXPECT_EQ(sum(0), 0b101U ^ (0b1111U ^ 0b1000U) << 3);
  EXPECT_EQ(sum(0x10000), 0b101U ^ (0b1111U ^ 0b1000U ^ 0b101U) << 3);
}

// Blocks are of 16 to 1408 bytes: lengths around both, and several blocks.
template <typename Crc>
void expect_the_bytewise_one(std::uint32_t (*bytewise)(std::span<const std::byte>)) {
  tests::Random random(54);
  std::vector<std::byte> bytes(3'000);
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(random.next());
  }
  for (const std::size_t length :
       {15U, 16U, 17U, 31U, 32U, 33U, 48U, 1'024U, 1'407U, 1'408U, 1'439U, 1'440U, 3'000U}) {
    for (const std::size_t start : {0U, 4U, 13U}) {
      const auto part = std::span(bytes).first(length).subspan(start);
      Crc crc;
      crc.update(std::span(bytes).first(start));
      crc.update(part);
      ASSERT_EQ(crc.value(), bytewise(std::span(bytes).first(length))) << length << ' ' << start;
    }
  }
}

template <std::uint32_t kPolynomial>
std::uint32_t bytewise(std::span<const std::byte> bytes) {
  ReflectedCrc32<kPolynomial, 1> crc;
  crc.update(bytes);
  return crc.value();
}

TEST(ProductCrc32, IsTheBytewiseOne) {
  expect_the_bytewise_one<ProductCrc32<0x04C11DB7, PlainProducts>>(bytewise<0x04C11DB7>);
  expect_the_bytewise_one<ProductCrc32<0xF4ACFB13, PlainProducts>>(bytewise<0xF4ACFB13>);
}

template <std::uint32_t kPolynomial, std::size_t kBytes>
void expect_the_bytewise_zeros() {
  const std::vector<std::byte> zeros(kBytes);
  for (const std::uint32_t state : {0U, 1U, 0x8000'0000U, 0xFFFF'FFFFU, 0x1234'5678U}) {
    ReflectedCrc32<kPolynomial, 1> crc;
    crc.set_state(state);
    crc.update(zeros);
    using Products = ProductCrc32<kPolynomial, PlainProducts>;
    EXPECT_EQ(Products::template after_zeros<kBytes>(state), crc.state()) << state;
  }
}

TEST(ProductCrc32, PassesOverZerosAsTheBytewiseOne) {
  expect_the_bytewise_zeros<0x04C11DB7, 8>();
  expect_the_bytewise_zeros<0x04C11DB7, 1024>();
  expect_the_bytewise_zeros<0xF4ACFB13, 1024>();
}

TEST(ProductCrc32, PassesOverZerosBehindBytesAsTheBytewiseOne) {
  constexpr std::size_t kZeros = 1024;
  constexpr std::size_t kMost = 40;
  tests::Random random(55);
  std::vector<std::byte> bytes(kMost + kZeros);
  std::ranges::generate(std::span(bytes).first<kMost>(),
                        [&] { return static_cast<std::byte>(random.next()); });
  for (std::size_t before = kProductLanes; before <= kMost; ++before) {
    const auto all = std::span<const std::byte>(bytes).subspan(kMost - before);
    ReflectedCrc32<0xF4ACFB13, 1> crc;
    const std::uint32_t state = crc.state();
    crc.update(all);
    using Products = ProductCrc32<0xF4ACFB13, PlainProducts>;
    EXPECT_EQ((Products::after_zeros<kZeros, kMost>(state, all.first(before))), crc.state())
        << before;
  }
}

// On the target this is the twin.
TEST(FastCrc32, IsTheBytewiseOne) {
  expect_the_bytewise_one<Crc32>(bytewise<0x04C11DB7>);
  expect_the_bytewise_one<Crc32P4>(bytewise<0xF4ACFB13>);
}

}  // namespace
}  // namespace iog::checksum
