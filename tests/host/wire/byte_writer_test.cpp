#include "wire/byte_writer.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <vector>

namespace iog::wire {
namespace {

constexpr std::byte kUntouched{0xEE};

std::vector<unsigned> as_numbers(std::span<const std::byte> bytes) {
  std::vector<unsigned> numbers;
  for (const std::byte byte : bytes) {
    numbers.push_back(std::to_integer<unsigned>(byte));
  }
  return numbers;
}

TEST(ByteWriter, WritesInOrderAndEndsOk) {
  std::vector<std::byte> buffer(29);
  ByteWriter writer{buffer};
  writer.u8(0x01);
  writer.u16_be(0x0203);
  writer.u16_le(0x0504);
  writer.u32_be(0x06070809);
  writer.u32_le(0x0D0C0B0A);
  writer.u64_be(0x0E0F101112131415);
  writer.u64_le(0x1D1C1B1A19181716);
  EXPECT_TRUE(writer.ok());
  EXPECT_EQ(writer.remaining(), 0U);
  for (std::size_t i = 0; i < buffer.size(); ++i) {
    EXPECT_EQ(std::to_integer<std::size_t>(buffer[i]), i + 1);
  }
}

TEST(ByteWriter, WritesTwosComplement) {
  std::array<std::byte, 13> buffer{};
  ByteWriter writer{buffer};
  writer.i8(-128);
  writer.i16_be(-2);
  writer.i16_le(-2);
  writer.i32_be(-3);
  writer.i32_le(INT32_MIN);
  EXPECT_TRUE(writer.ok());
  EXPECT_EQ(as_numbers(buffer), (std::vector<unsigned>{0x80, 0xFF, 0xFE, 0xFE, 0xFF, 0xFF, 0xFF,
                                                       0xFF, 0xFD, 0x00, 0x00, 0x00, 0x80}));
}

TEST(ByteWriter, SkipsLeaveAndZerosClear) {
  std::array<std::byte, 6> buffer{};
  buffer.fill(kUntouched);
  constexpr std::array<std::byte, 2> kSource{std::byte{0x11}, std::byte{0x22}};
  ByteWriter writer{buffer};
  writer.bytes(kSource);
  writer.skip(1);
  writer.zeros(2);
  EXPECT_EQ(writer.written().data(), buffer.data());
  EXPECT_EQ(writer.written().size(), 5U);
  EXPECT_EQ(writer.remaining(), 1U);
  EXPECT_EQ(as_numbers(buffer), (std::vector<unsigned>{0x11, 0x22, 0xEE, 0, 0, 0xEE}));
}

// The law of every write: with one byte too few it changes nothing, and nothing is written after
// it.
template <typename Write>
void expect_fails_one_byte_short(std::size_t width, Write write) {
  std::vector<std::byte> buffer(width, kUntouched);
  ByteWriter writer{buffer};
  writer.u8(0x77);
  write(writer);
  EXPECT_FALSE(writer.ok()) << width;
  EXPECT_EQ(writer.written().size(), 1U) << width;
  EXPECT_EQ(writer.remaining(), 0U) << width;
  writer.u8(0x55);
  writer.zeros(0);
  EXPECT_FALSE(writer.ok()) << "failure is sticky";
  EXPECT_EQ(buffer[0], std::byte{0x77});
  EXPECT_TRUE(std::all_of(buffer.begin() + 1, buffer.end(), [](std::byte byte) {
    return byte == kUntouched;
  })) << width;
}

TEST(ByteWriter, FailsOneByteShortAndStaysFailed) {
  expect_fails_one_byte_short(1, [](ByteWriter& w) { w.u8(0); });
  expect_fails_one_byte_short(2, [](ByteWriter& w) { w.u16_be(0); });
  expect_fails_one_byte_short(2, [](ByteWriter& w) { w.u16_le(0); });
  expect_fails_one_byte_short(4, [](ByteWriter& w) { w.u32_be(0); });
  expect_fails_one_byte_short(4, [](ByteWriter& w) { w.i32_le(0); });
  expect_fails_one_byte_short(8, [](ByteWriter& w) { w.u64_be(0); });
  expect_fails_one_byte_short(8, [](ByteWriter& w) { w.u64_le(0); });
  expect_fails_one_byte_short(5, [](ByteWriter& w) { w.zeros(5); });
  expect_fails_one_byte_short(5, [](ByteWriter& w) { w.skip(5); });
  expect_fails_one_byte_short(5, [](ByteWriter& w) { w.bytes(std::array<std::byte, 5>{}); });
}

TEST(ByteWriter, CannotBeOverflowedBySizes) {
  std::array<std::byte, 4> buffer{};
  ByteWriter writer{buffer};
  writer.u8(1);
  writer.skip(SIZE_MAX);
  EXPECT_FALSE(writer.ok());
  EXPECT_EQ(writer.written().size(), 1U);
}

TEST(ByteWriter, EmptyBufferIsOkUntilItIsWritten) {
  ByteWriter writer{{}};
  writer.zeros(0);
  EXPECT_TRUE(writer.ok());
  writer.u8(1);
  EXPECT_FALSE(writer.ok());
}

constexpr std::array<std::byte, 3> written_at_compile_time() {
  std::array<std::byte, 3> buffer{};
  ByteWriter writer{buffer};
  writer.u16_be(0x0102);
  writer.u8(3);
  return buffer;
}
static_assert(written_at_compile_time() ==
              std::array<std::byte, 3>{std::byte{1}, std::byte{2}, std::byte{3}});

}  // namespace
}  // namespace iog::wire
