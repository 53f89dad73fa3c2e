// Bytes by their bits, and the S-box of AES against its definition.
#include "authentication/planes.hpp"

#include <gtest/gtest.h>

#include "blocks.hpp"

namespace iog::authentication {
namespace {

// FIPS 197, section 4.2.
unsigned times(unsigned a, unsigned b) {
  unsigned product = 0;
  for (; b != 0; b >>= 1) {
    product ^= (b & 1) != 0 ? a : 0;
    a = a << 1 ^ ((a & 0x80) != 0 ? 0x11B : 0);
  }
  return product;
}

// FIPS 197, section 5.1.1: the inverse, which is the power of 254, and the affine map.
unsigned s_box(unsigned byte) {
  unsigned inverse = 1;
  for (int i = 0; i < 254; ++i) {
    inverse = times(inverse, byte);
  }
  unsigned result = 0x63;
  for (unsigned turn = 0; turn < 5; ++turn) {
    result ^= (inverse << turn | inverse >> (8 - turn)) & 0xFF;
  }
  return result;
}

TEST(Planes, ABlockComesBackAsItWent) {
  const Block block = testing::block_from("00112233 44556677 8899aabb ccddeeff");
  EXPECT_EQ(block_of(planes_of(block)), block);
  EXPECT_EQ(column_of(planes_of_column(0x12345678)), 0x12345678U);
}

TEST(Planes, APlaneHoldsOneBitOfEachByte) {
  for (std::size_t at = 0; at < kBlockBytes; ++at) {
    for (unsigned bit = 0; bit < 8; ++bit) {
      Block block{};
      block.at(at) = static_cast<std::byte>(1U << bit);
      Planes expected{};
      expected.at(bit) = 1U << (8 * (at % 4) + 2 * (at / 4));
      EXPECT_EQ(planes_of(block), expected) << at << " " << bit;
    }
  }
}

TEST(Planes, TheSBoxIsThatOfTheStandard) {
  EXPECT_EQ(s_box(0x53), 0xEDU) << "the example of FIPS 197, section 5.1.1";
  for (unsigned byte = 0; byte < 256; ++byte) {
    Block block{};
    block.fill(static_cast<std::byte>(byte));
    block[5] = static_cast<std::byte>(255 - byte);
    Planes planes = planes_of(block);
    substitute(planes);
    Block expected{};
    expected.fill(static_cast<std::byte>(s_box(byte)));
    expected[5] = static_cast<std::byte>(s_box(255 - byte));
    EXPECT_EQ(block_of(planes), expected) << byte;
  }
}

}  // namespace
}  // namespace iog::authentication
