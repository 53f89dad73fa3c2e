// Sums of carry-less products, and the CRC made of them.
#include "checksum/products.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "checksum/crc32.hpp"
#include "checksum/product_crc32.hpp"
#include "checksum/reflected_crc32.hpp"
#include "fakes/random.hpp"

namespace iog::checksum {
namespace {

using Eight = std::array<std::byte, kProductLanes>;

// By hand: (x + 1)(x^2 + 1) = x^3 + x^2 + x + 1, and nothing is carried; sums of equals vanish.
TEST(Products, AreThoseOfPolynomials) {
  Eight bytes{};
  Factors factors;
  bytes[2] = std::byte{0b11};
  factors.set(2, 0b101);
  PlainProducts products;
  products.add(bytes, factors);
  EXPECT_EQ(products.sum(), 0b1111U);
  bytes[2] = std::byte{0x80};
  factors.set(2, 0x8000'0001);
  products.add(bytes, factors);
  EXPECT_EQ(products.sum(), 0x40'0000'0080U ^ 0b1111U);
  products.add(bytes, factors);
  EXPECT_EQ(products.sum(), 0b1111U);
}

// Blocks are of 32 to 1024 bytes: lengths around both, and several blocks.
template <typename Crc>
void expect_the_bytewise_one(std::uint32_t (*bytewise)(std::span<const std::byte>)) {
  tests::Random random(54);
  std::vector<std::byte> bytes(2'200);
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(random.next());
  }
  for (const std::size_t length : {31U, 32U, 33U, 48U, 1'023U, 1'024U, 1'039U, 1'040U, 2'200U}) {
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

// On the target this is the twin.
TEST(FastCrc32, IsTheBytewiseOne) {
  expect_the_bytewise_one<Crc32>(bytewise<0x04C11DB7>);
  expect_the_bytewise_one<Crc32P4>(bytewise<0xF4ACFB13>);
}

}  // namespace
}  // namespace iog::checksum
