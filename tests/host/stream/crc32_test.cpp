#include "stream/crc32.hpp"

#include <array>
#include <gtest/gtest.h>
#include <string_view>
#include <vector>

#include "fakes/random.hpp"

namespace iog::stream {
namespace {

std::uint32_t crc_of(std::string_view text) {
  Crc32 crc;
  crc.update(std::as_bytes(std::span(text)));
  return crc.value();
}

// Check values of CRC-32/ISO-HDLC in the catalogue of parametrised CRC algorithms (G. Cook), and of
// zlib.crc32.
TEST(Crc32, GivesThePublishedValues) {
  EXPECT_EQ(crc_of(""), 0U);
  EXPECT_EQ(crc_of("123456789"), 0xCBF43926U);
  EXPECT_EQ(crc_of("a"), 0xE8B7BE43U);
  EXPECT_EQ(crc_of("The quick brown fox jumps over the lazy dog"), 0x414FA339U);
}

// Bit by bit, straight from the polynomial.
std::uint32_t slow_crc(const std::vector<std::byte>& bytes) {
  std::uint32_t state = 0xFFFFFFFF;
  for (const std::byte byte : bytes) {
    state ^= std::to_integer<std::uint32_t>(byte);
    for (int bit = 0; bit < 8; ++bit) {
      state = (state & 1U) != 0 ? (state >> 1) ^ 0xEDB88320U : state >> 1;
    }
  }
  return ~state;
}

TEST(Crc32, SlicingEqualsBitByBitAtEveryLengthAndSplit) {
  tests::Random random(51);
  std::vector<std::byte> bytes;
  for (int length = 0; length < 70; ++length) {
    const std::uint32_t expected = slow_crc(bytes);
    for (std::size_t split = 0; split <= bytes.size(); ++split) {
      Crc32 crc;
      crc.update(std::span(bytes).first(split));
      crc.update(std::span(bytes).subspan(split));
      ASSERT_EQ(crc.value(), expected);
    }
    bytes.push_back(static_cast<std::byte>(random.next()));
  }
}

}  // namespace
}  // namespace iog::stream
