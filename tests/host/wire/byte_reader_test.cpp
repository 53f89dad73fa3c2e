#include "wire/byte_reader.hpp"

#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace iog::wire {
namespace {

std::vector<std::byte> counting(std::size_t size) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) {
    bytes[i] = static_cast<std::byte>(i + 1);
  }
  return bytes;
}

TEST(ByteReader, ReadsInOrderAndEndsOk) {
  const auto bytes = counting(1 + 2 + 2 + 4 + 4 + 8 + 8);
  ByteReader reader{bytes};
  EXPECT_EQ(reader.u8(), 0x01);
  EXPECT_EQ(reader.u16_be(), 0x0203);
  EXPECT_EQ(reader.u16_le(), 0x0504);
  EXPECT_EQ(reader.u32_be(), 0x06070809U);
  EXPECT_EQ(reader.u32_le(), 0x0D0C0B0AU);
  EXPECT_EQ(reader.u64_be(), 0x0E0F101112131415U);
  EXPECT_EQ(reader.u64_le(), 0x1D1C1B1A19181716U);
  EXPECT_EQ(reader.remaining(), 0U);
  EXPECT_TRUE(reader.ok());
}

TEST(ByteReader, ReadsTwosComplement) {
  constexpr std::array<std::byte, 13> kBytes{
      std::byte{0x80}, std::byte{0xFF}, std::byte{0xFE}, std::byte{0xFE}, std::byte{0xFF},
      std::byte{0xFF}, std::byte{0xFF}, std::byte{0xFF}, std::byte{0xFD}, std::byte{0x00},
      std::byte{0x00}, std::byte{0x00}, std::byte{0x80}};
  ByteReader reader{kBytes};
  EXPECT_EQ(reader.i8(), -128);
  EXPECT_EQ(reader.i16_be(), -2);
  EXPECT_EQ(reader.i16_le(), -2);
  EXPECT_EQ(reader.i32_be(), -3);
  EXPECT_EQ(reader.i32_le(), INT32_MIN);
  EXPECT_TRUE(reader.ok());
}

TEST(ByteReader, ViewsBytesInPlace) {
  const auto bytes = counting(6);
  ByteReader reader{bytes};
  reader.skip(2);
  const auto view = reader.bytes(3);
  EXPECT_EQ(view.data(), bytes.data() + 2);
  EXPECT_EQ(view.size(), 3U);
  EXPECT_EQ(reader.remaining(), 1U);
  EXPECT_EQ(reader.u8(), 6);
  EXPECT_TRUE(reader.ok());
}

TEST(ByteReader, EmptyInputIsOkUntilItIsRead) {
  ByteReader reader{{}};
  EXPECT_EQ(reader.remaining(), 0U);
  EXPECT_TRUE(reader.bytes(0).empty());
  reader.skip(0);
  EXPECT_TRUE(reader.ok());
  EXPECT_EQ(reader.u8(), 0);
  EXPECT_FALSE(reader.ok());
}

// The law of every read: with one byte too few it returns 0, and nothing is read after it.
template <typename Read>
void expect_fails_one_byte_short(std::size_t width, Read read) {
  const auto bytes = counting(width - 1);
  ByteReader reader{bytes};
  EXPECT_EQ(read(reader), 0U) << width;
  EXPECT_FALSE(reader.ok()) << width;
  EXPECT_EQ(reader.remaining(), 0U) << width;
  EXPECT_EQ(reader.u8(), 0) << "a shorter read must not succeed after a failure";
  EXPECT_TRUE(reader.bytes(0).empty());
  EXPECT_FALSE(reader.ok()) << "failure is sticky";
}

TEST(ByteReader, FailsOneByteShortAndStaysFailed) {
  expect_fails_one_byte_short(1, [](ByteReader& r) { return std::uint64_t{r.u8()}; });
  expect_fails_one_byte_short(2, [](ByteReader& r) { return std::uint64_t{r.u16_be()}; });
  expect_fails_one_byte_short(2, [](ByteReader& r) { return std::uint64_t{r.u16_le()}; });
  expect_fails_one_byte_short(4, [](ByteReader& r) { return std::uint64_t{r.u32_be()}; });
  expect_fails_one_byte_short(4, [](ByteReader& r) { return std::uint64_t{r.u32_le()}; });
  expect_fails_one_byte_short(8, [](ByteReader& r) { return r.u64_be(); });
  expect_fails_one_byte_short(8, [](ByteReader& r) { return r.u64_le(); });
  expect_fails_one_byte_short(5, [](ByteReader& r) { return r.bytes(5).size(); });
}

TEST(ByteReader, CannotBeOverflowedBySizes) {
  const auto bytes = counting(4);
  ByteReader reader{bytes};
  reader.skip(1);
  reader.skip(SIZE_MAX);
  EXPECT_FALSE(reader.ok());
  ByteReader again{bytes};
  again.skip(1);
  EXPECT_TRUE(again.bytes(SIZE_MAX - 1).empty());
  EXPECT_FALSE(again.ok());
}

constexpr std::uint32_t sum_at_compile_time() {
  constexpr std::array<std::byte, 3> kBytes{std::byte{1}, std::byte{2}, std::byte{3}};
  ByteReader reader{kBytes};
  return reader.u16_be() + std::uint32_t{reader.u8()};
}
static_assert(sum_at_compile_time() == 0x0105);

}  // namespace
}  // namespace iog::wire
