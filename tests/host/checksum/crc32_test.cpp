#include "checksum/crc32.hpp"

#include <gtest/gtest.h>
#include <string_view>
#include <utility>
#include <vector>

#include "checksum/reflected_crc32.hpp"
#include "fakes/bitwise_crc32.hpp"
#include "fakes/random.hpp"

namespace iog::checksum {
namespace {

template <typename Crc>
std::uint32_t crc_of(std::span<const std::byte> bytes) {
  Crc crc;
  crc.update(bytes);
  return crc.value();
}

template <typename Crc>
std::uint32_t crc_of(std::string_view text) {
  return crc_of<Crc>(std::as_bytes(std::span(text)));
}

using tests::BitwiseCrc32;

// Check values of CRC-32/ISO-HDLC in the catalogue of parametrised CRC algorithms (G. Cook), and of
// zlib.crc32.
TEST(Crc32, GivesThePublishedValues) {
  EXPECT_EQ(crc_of<Crc32>(""), 0U);
  EXPECT_EQ(crc_of<Crc32>("123456789"), 0xCBF43926U);
  EXPECT_EQ(BitwiseCrc32().add(std::as_bytes(std::span("123456789", 9))).value(), 0xCBF43926U);
  EXPECT_EQ(crc_of<Crc32>("a"), 0xE8B7BE43U);
  EXPECT_EQ(crc_of<Crc32>("The quick brown fox jumps over the lazy dog"), 0x414FA339U);
}

struct Example {
  std::vector<std::uint8_t> bytes;
  std::uint32_t crc;
};

// AUTOSAR SWS CRCLibrary, examples of CRC-32/P4 (polynomial 0xF4ACFB13), and its check value.
TEST(Crc32P4, GivesThePublishedValues) {
  const std::vector<Example> examples{
      {{0x00, 0x00, 0x00, 0x00}, 0x6FB32240},
      {{0xF2, 0x01, 0x83}, 0x4F721A25},
      {{0x0F, 0xAA, 0x00, 0x55}, 0x20662DF8},
      {{0x00, 0xFF, 0x55, 0x11}, 0x9BD7996E},
      {{0x33, 0x22, 0x55, 0xAA, 0xBB, 0xCC, 0xDD, 0xEE, 0xFF}, 0xA65A343D},
      {{0x92, 0x6B, 0x55}, 0xEE688A78},
      {{0xFF, 0xFF, 0xFF, 0xFF}, 0xFFFFFFFF},
  };
  for (const Example& example : examples) {
    EXPECT_EQ(crc_of<Crc32P4>(std::as_bytes(std::span(example.bytes))), example.crc);
  }
  EXPECT_EQ(crc_of<Crc32P4>("123456789"), 0x1697D06AU);
}

template <typename Crc>
void expect_the_slow_one(std::uint32_t mirrored_polynomial) {
  tests::Random random(51);
  std::vector<std::byte> bytes;
  for (int length = 0; length < 70; ++length) {
    const std::uint32_t expected = BitwiseCrc32(mirrored_polynomial).add(bytes).value();
    for (std::size_t split = 0; split <= bytes.size(); ++split) {
      Crc crc;
      crc.update(std::span(bytes).first(split));
      crc.update(std::span(bytes).subspan(split));
      ASSERT_EQ(crc.value(), expected);
    }
    bytes.push_back(static_cast<std::byte>(random.next()));
  }
}

TEST(Crc32, EveryWayEqualsBitByBitAtEveryLengthAndSplit) {
  expect_the_slow_one<ReflectedCrc32<0x04C11DB7, 1>>(BitwiseCrc32::kIsoHdlc);
  expect_the_slow_one<ReflectedCrc32<0x04C11DB7, 4>>(BitwiseCrc32::kIsoHdlc);
  expect_the_slow_one<ReflectedCrc32<0x04C11DB7, 8>>(BitwiseCrc32::kIsoHdlc);
  expect_the_slow_one<ReflectedCrc32<0x04C11DB7, 16>>(BitwiseCrc32::kIsoHdlc);
  expect_the_slow_one<Crc32>(BitwiseCrc32::kIsoHdlc);
}

TEST(Crc32P4, EveryWayEqualsBitByBitAtEveryLengthAndSplit) {
  expect_the_slow_one<ReflectedCrc32<0xF4ACFB13, 1>>(BitwiseCrc32::kP4);
  expect_the_slow_one<ReflectedCrc32<0xF4ACFB13, 4>>(BitwiseCrc32::kP4);
  expect_the_slow_one<ReflectedCrc32<0xF4ACFB13, 8>>(BitwiseCrc32::kP4);
  expect_the_slow_one<ReflectedCrc32<0xF4ACFB13, 16>>(BitwiseCrc32::kP4);
  expect_the_slow_one<Crc32P4>(BitwiseCrc32::kP4);
}

// What the polynomial is chosen for: five flipped bits never go unseen. A sample of them in a
// message as long as ours.
TEST(Crc32P4, SeesUpToFiveFlippedBits) {
  tests::Random random(52);
  std::vector<std::byte> message(1'100);
  for (std::byte& byte : message) {
    byte = static_cast<std::byte>(random.next());
  }
  const std::uint32_t whole = crc_of<Crc32P4>(message);
  for (int trial = 0; trial < 500; ++trial) {
    auto damaged = message;
    for (int flips = random.between(1, 5); flips > 0; --flips) {
      damaged.at(random.below(damaged.size())) ^= std::byte{1} << random.between(0, 7);
    }
    ASSERT_TRUE(damaged == message || crc_of<Crc32P4>(damaged) != whole);
  }
}

// Bytes before, a part of which only the remainder is known, and bytes after.
template <typename Crc>
void expect_the_slow_one_by_a_remainder(std::uint32_t mirrored_polynomial) {
  tests::Random random(52);
  std::vector<std::byte> bytes(Crc::kPartBytes + 40);
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(random.next());
  }
  for (std::size_t before = 0; before <= 40; before += 4) {
    const auto part = std::span(bytes).subspan(before);
    Crc crc;
    crc.update(std::span(bytes).first(before));
    crc.add_remainder(Crc::remainder_of(part.template first<Crc::kPartBytes>()));
    crc.update(part.subspan(Crc::kPartBytes));
    ASSERT_EQ(crc.value(), BitwiseCrc32(mirrored_polynomial).add(bytes).value()) << before;
  }
}

// The same, and up to four bytes before it are added with it.
template <typename Crc, std::size_t kBefore>
void expect_the_slow_one_by_bytes_and_a_remainder(std::uint32_t mirrored_polynomial) {
  tests::Random random(53 + kBefore);
  std::vector<std::byte> bytes(9 + kBefore + Crc::kPartBytes);
  for (std::byte& byte : bytes) {
    byte = static_cast<std::byte>(random.next());
  }
  const std::span<const std::byte> all = bytes;
  Crc crc;
  crc.update(all.first(9));
  crc.add_remainder(all.subspan<9, kBefore>(), Crc::remainder_of(all.last<Crc::kPartBytes>()));
  EXPECT_EQ(crc.value(), BitwiseCrc32(mirrored_polynomial).add(bytes).value()) << kBefore;
}

TEST(Crc32, APartIsAddedWithTheBytesBeforeIt) {
  [&]<std::size_t... kBefore>(std::index_sequence<kBefore...> /*before*/) {
    (expect_the_slow_one_by_bytes_and_a_remainder<Crc32, kBefore>(BitwiseCrc32::kIsoHdlc), ...);
    (expect_the_slow_one_by_bytes_and_a_remainder<Crc32P4, kBefore>(BitwiseCrc32::kP4), ...);
  }
  (std::make_index_sequence<5>());
}

// The same for any number of bytes, around the shortest and the longest that have a way of their
// own.
template <typename Crc>
void expect_the_slow_one_by_a_head_and_a_remainder(std::uint32_t mirrored_polynomial) {
  tests::Random random(58);
  for (std::size_t before = 0; before <= 140; ++before) {
    std::vector<std::byte> bytes(3 + before + Crc::kPartBytes);
    for (std::byte& byte : bytes) {
      byte = static_cast<std::byte>(random.next());
    }
    const std::span<const std::byte> all = bytes;
    Crc crc;
    crc.update(all.first(3));
    crc.add_remainder(all.subspan(3, before),
                      Crc::remainder_of(all.template last<Crc::kPartBytes>()));
    ASSERT_EQ(crc.value(), BitwiseCrc32(mirrored_polynomial).add(bytes).value()) << before;
  }
}

TEST(Crc32, APartIsAddedWithAHead) {
  expect_the_slow_one_by_a_head_and_a_remainder<Crc32>(BitwiseCrc32::kIsoHdlc);
  expect_the_slow_one_by_a_head_and_a_remainder<Crc32P4>(BitwiseCrc32::kP4);
}

TEST(Crc32, APartIsAddedByItsRemainder) {
  expect_the_slow_one_by_a_remainder<Crc32>(BitwiseCrc32::kIsoHdlc);
  expect_the_slow_one_by_a_remainder<Crc32P4>(BitwiseCrc32::kP4);
}

}  // namespace
}  // namespace iog::checksum
