// The bytes 01 02 .. 08 read as a number in each order, worked out by hand.
#include "wire/byte_order.hpp"

#include <array>
#include <gtest/gtest.h>

namespace iog::wire {
namespace {

constexpr std::array<std::byte, 8> kBytes{std::byte{0x01}, std::byte{0x02}, std::byte{0x03},
                                          std::byte{0x04}, std::byte{0x05}, std::byte{0x06},
                                          std::byte{0x07}, std::byte{0x08}};
constexpr std::span<const std::byte, 8> kAll{kBytes};

static_assert(load_u8(kAll.first<1>()) == 0x01);
static_assert(load_be16(kAll.first<2>()) == 0x0102);
static_assert(load_le16(kAll.first<2>()) == 0x0201);
static_assert(load_be32(kAll.first<4>()) == 0x01020304);
static_assert(load_le32(kAll.first<4>()) == 0x04030201);
static_assert(load_be64(kAll) == 0x0102030405060708);
static_assert(load_le64(kAll) == 0x0807060504030201);

// The same at run time, at every alignment: on the Cortex-A9 these become single unaligned loads.
TEST(ByteOrder, LoadsAtEveryAlignment) {
  for (std::size_t offset = 0; offset < 8; ++offset) {
    std::array<std::byte, 16> shifted{};
    const auto place = std::span{shifted}.subspan(offset).first<8>();
    for (std::size_t i = 0; i < kBytes.size(); ++i) {
      place[i] = kBytes[i];
    }
    EXPECT_EQ(load_be16(place.first<2>()), 0x0102);
    EXPECT_EQ(load_le16(place.first<2>()), 0x0201);
    EXPECT_EQ(load_be32(place.first<4>()), 0x01020304U);
    EXPECT_EQ(load_le32(place.first<4>()), 0x04030201U);
    EXPECT_EQ(load_be64(place), 0x0102030405060708U);
    EXPECT_EQ(load_le64(place), 0x0807060504030201U);
  }
}

TEST(ByteOrder, LoadsTheTopBitWithoutSign) {
  constexpr std::array<std::byte, 8> kOnes{std::byte{0xFF}, std::byte{0xFF}, std::byte{0xFF},
                                           std::byte{0xFF}, std::byte{0xFF}, std::byte{0xFF},
                                           std::byte{0xFF}, std::byte{0xFF}};
  const std::span<const std::byte, 8> ones{kOnes};
  EXPECT_EQ(load_u8(ones.first<1>()), 0xFF);
  EXPECT_EQ(load_be16(ones.first<2>()), 0xFFFF);
  EXPECT_EQ(load_le32(ones.first<4>()), 0xFFFF'FFFFU);
  EXPECT_EQ(load_be64(ones), 0xFFFF'FFFF'FFFF'FFFFU);
}

TEST(ByteOrder, StoresWhatLoadsReadAtEveryAlignment) {
  for (std::size_t offset = 0; offset < 8; ++offset) {
    std::array<std::byte, 16> buffer{};
    const auto place = std::span{buffer}.subspan(offset).first<8>();
    store_u8(place.first<1>(), 0xA5);
    EXPECT_EQ(place[0], std::byte{0xA5});
    store_be16(place.first<2>(), 0x0102);
    EXPECT_EQ(load_be16(place.first<2>()), 0x0102);
    EXPECT_EQ(place[0], std::byte{0x01});
    store_le16(place.first<2>(), 0x0102);
    EXPECT_EQ(place[0], std::byte{0x02});
    EXPECT_EQ(place[1], std::byte{0x01});
    store_be32(place.first<4>(), 0x01020304);
    EXPECT_EQ(load_be32(place.first<4>()), 0x01020304U);
    store_le32(place.first<4>(), 0x01020304);
    EXPECT_EQ(load_be32(place.first<4>()), 0x04030201U);
    store_be64(place, 0x0102030405060708);
    EXPECT_EQ(load_be64(place), 0x0102030405060708U);
    store_le64(place, 0x0102030405060708);
    EXPECT_EQ(load_be64(place), 0x0807060504030201U);
  }
}

}  // namespace
}  // namespace iog::wire
