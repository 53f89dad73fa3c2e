#include "tile_coding/bit_stream.hpp"

#include <array>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::tile_coding {
namespace {

TEST(BitStream, TheHighestBitOfAByteComesFirst) {
  std::array<std::byte, 8> buffer{};
  BitWriter out(buffer);
  out.put(0b1, 1);
  out.put(0b01, 2);
  out.put(0b1111'0000'1, 9);
  EXPECT_EQ(out.finish(), 2U);
  EXPECT_EQ(buffer[0], std::byte{0b1011'1110});
  EXPECT_EQ(buffer[1], std::byte{0b0001'0000});
}

struct Field {
  std::uint32_t value;
  unsigned bits;
};

TEST(BitStream, WhatIsWrittenIsRead) {
  tests::Random random(91);
  for (int i = 0; i < tests::effort(5'000, 200); ++i) {
    std::vector<Field> fields(random.below(60));
    std::size_t total = 0;
    for (Field& field : fields) {
      field.bits = static_cast<unsigned>(random.between(1, 31));
      field.value = static_cast<std::uint32_t>(random.next()) >> (32 - field.bits);
      total += field.bits;
    }
    std::vector<std::byte> buffer((total + 7) / 8);
    BitWriter out(buffer);
    for (const Field& field : fields) {
      out.put(field.value, field.bits);
    }
    ASSERT_EQ(out.finish(), buffer.size());
    BitReader in(buffer);
    for (const Field& field : fields) {
      ASSERT_EQ(in.bits(field.bits), field.value);
    }
    ASSERT_TRUE(in.ends_here());
  }
}

TEST(BitStream, ReadingBeyondTheEndGivesZerosAndIsSeen) {
  const std::array<std::byte, 1> bytes{std::byte{0xFF}};
  BitReader in(bytes);
  EXPECT_EQ(in.bits(7), 0x7FU);
  EXPECT_TRUE(in.ok());
  EXPECT_EQ(in.bits(3), 0b100U);
  EXPECT_FALSE(in.ok());
}

TEST(BitStream, PaddingIsLessThanAByteAndZero) {
  const std::array<std::byte, 2> bytes{std::byte{0xF0}, std::byte{0x00}};
  BitReader in(bytes);
  EXPECT_EQ(in.bits(4), 0xFU);
  auto early = in;
  EXPECT_FALSE(early.ends_here());
  EXPECT_EQ(in.bits(5), 0U);
  EXPECT_TRUE(in.ends_here());
  BitReader not_zero{std::span(bytes).first(1)};
  EXPECT_EQ(not_zero.bits(3), 0b111U);
  EXPECT_FALSE(not_zero.ends_here());
}

}  // namespace
}  // namespace iog::tile_coding
