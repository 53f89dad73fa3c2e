#include "pose/message.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "fakes/pose_bytes.hpp"
#include "fakes/random.hpp"

namespace iog::pose {
namespace {

using tests::PoseBytes;

constexpr Message kMessage{
    .run = 0x01020304,
    .age_us = 199'999,
    .clock_us = 0x1112131415161718,
    .pose = {.x_mm = -1'000'000'000, .y_mm = 999'999'999, .heading = 0xC0000001},
    .sigma = {.position_mm = 25, .heading_10urad = 0xFFFF},
    .speed_mm_per_s = -1'500,
    .yaw_urad_per_s = 500'000,
    .map = MapTransform{.origin = 0xF1F2F3F4F5F6F7F8,
                        .local_frame = {.x_mm = 4, .y_mm = -5, .heading = 6},
                        .sigma = {.position_mm = 300, .heading_10urad = 2}}};

// The same, at the offsets of docs/spec.md.
PoseBytes bytes_of_message() {
  PoseBytes bytes;
  bytes.put(29, 1, 1).put(32, 4, 0x01020304).put(36, 4, 199'999);
  bytes.put(40, 8, 0x1112131415161718);
  bytes.put(48, 4, -1'000'000'000).put(52, 4, 999'999'999).put(56, 4, 0xC0000001);
  bytes.put(60, 2, 25).put(62, 2, 0xFFFF).put(64, 4, -1'500).put(68, 4, 500'000);
  bytes.put(72, 4, 0xF1F2F3F4).put(76, 4, 0xF5F6F7F8);
  bytes.put(80, 4, 4).put(84, 4, -5).put(88, 4, 6).put(92, 2, 300).put(94, 2, 2);
  return bytes.seal();
}

Fate fate_of(PoseBytes& bytes) { return decode(bytes.seal().bytes()).fate; }

TEST(PoseMessage, IsWrittenAsTheSpecificationSays) {
  Encoder encoder;
  PoseBytes expected = bytes_of_message();
  EXPECT_TRUE(std::ranges::equal(encoder.encode(kMessage), expected.bytes()));
  expected.put(10, 2, 2).put(18, 2, 1).seal();  // session and counter go on
  EXPECT_TRUE(std::ranges::equal(encoder.encode(kMessage), expected.bytes()));
}

TEST(PoseMessage, WithoutAMapItsFieldsAreZero) {
  Encoder encoder;
  const Message message{.run = 7, .clock_us = 3'000'000, .sigma = {1, 1}};
  EXPECT_TRUE(std::ranges::equal(encoder.encode(message), PoseBytes().bytes()));
}

TEST(PoseMessage, IsReadAsTheSpecificationSays) {
  const Decoded decoded = decode(bytes_of_message().bytes());
  ASSERT_EQ(decoded.fate, Fate::kUsed);
  EXPECT_EQ(decoded.message, kMessage);
  EXPECT_EQ(decode(PoseBytes().bytes()).message.map, std::nullopt);
}

// A later version of the content may be longer; what is known of it stays where it is.
TEST(PoseMessage, LongerContentIsReadAsFarAsItIsKnown) {
  PoseBytes bytes = bytes_of_message();
  bytes.resize(120).put(110, 4, 0x55555555).seal();
  ASSERT_EQ(decode(bytes.bytes()).fate, Fate::kUsed);
  EXPECT_EQ(decode(bytes.bytes()).message, kMessage);
  EXPECT_EQ(fate_of(bytes.put(30, 2, 72)), Fate::kWrongLength);
}

struct Fault {
  const char* what;
  std::size_t offset;
  std::size_t size;
  std::int64_t value;
  Fate fate;
};

// One field at a time, in a message whose CRC is right.
TEST(PoseMessage, EveryFaultHasItsName) {
  const std::vector<Fault> faults{{"another service", 0, 2, 0x4F48, Fate::kNotOurs},
                                  {"another event", 2, 2, 0x8001, Fate::kNotOurs},
                                  {"a request", 14, 1, 0, Fate::kNotOurs},
                                  {"another protocol version", 12, 1, 2, Fate::kNotOurs},
                                  {"another interface version", 13, 1, 2, Fate::kWrongVersion},
                                  {"another content version", 28, 1, 2, Fate::kWrongVersion},
                                  {"SOME/IP too long", 4, 4, 93, Fate::kDamaged},
                                  {"SOME/IP too short", 4, 4, 91, Fate::kDamaged},
                                  {"E2E too long", 16, 2, 93, Fate::kDamaged},
                                  {"the data id of tiles", 20, 4, 0x494F4701, Fate::kDamaged},
                                  {"header too short", 30, 2, 71, Fate::kWrongLength},
                                  {"header too long", 30, 2, 73, Fate::kWrongLength},
                                  {"a flag of tomorrow", 29, 1, 2, Fate::kWrongFlags},
                                  {"the highest flag", 29, 1, 0x81, Fate::kWrongFlags},
                                  {"reserved bytes", 96, 4, 1, Fate::kNotZero},
                                  {"age", 36, 4, 200'001, Fate::kTooOld},
                                  {"a clock of 2^62", 40, 8, 0x4000000000000000, Fate::kOutOfRange},
                                  {"the last clock", 40, 8, -1, Fate::kOutOfRange},
                                  {"x above", 48, 4, 1'000'000'001, Fate::kOutOfRange},
                                  {"x below", 48, 4, -1'000'000'001, Fate::kOutOfRange},
                                  {"y above", 52, 4, 0x7FFFFFFF, Fate::kOutOfRange},
                                  {"y below", 52, 4, -0x80000000LL, Fate::kOutOfRange},
                                  {"speed above", 64, 4, 100'001, Fate::kOutOfRange},
                                  {"speed below", 64, 4, -100'001, Fate::kOutOfRange},
                                  {"yaw rate above", 68, 4, 10'000'001, Fate::kOutOfRange},
                                  {"yaw rate below", 68, 4, -10'000'001, Fate::kOutOfRange},
                                  {"x of the map above", 80, 4, 1'000'000'001, Fate::kOutOfRange},
                                  {"y of the map below", 84, 4, -1'000'000'001, Fate::kOutOfRange},
                                  {"no sigma of position", 60, 2, 0, Fate::kNoSigma},
                                  {"no sigma of heading", 62, 2, 0, Fate::kNoSigma},
                                  {"no sigma of the map's position", 92, 2, 0, Fate::kNoSigma},
                                  {"no sigma of the map's heading", 94, 2, 0, Fate::kNoSigma}};
  for (const Fault& fault : faults) {
    PoseBytes bytes = bytes_of_message();
    EXPECT_EQ(fate_of(bytes.put(fault.offset, fault.size, fault.value)), fault.fate) << fault.what;
  }
}

TEST(PoseMessage, TheLastValuesThatMayBe) {
  PoseBytes bytes;
  bytes.put(29, 1, 1).put(36, 4, 200'000).put(48, 4, 1'000'000'000).put(52, 4, -1'000'000'000);
  bytes.put(64, 4, 100'000).put(68, 4, -10'000'000).put(92, 2, 0xFFFF).put(94, 2, 1);
  bytes.put(40, 8, 0x3FFFFFFFFFFFFFFF);
  EXPECT_EQ(fate_of(bytes), Fate::kUsed);
}

TEST(PoseMessage, NoByteOfTheMapStandsWithoutItsFlag) {
  for (std::size_t offset = 72; offset < 100; ++offset) {
    PoseBytes bytes;
    ASSERT_EQ(fate_of(bytes.put(offset, 1, 0x10)), Fate::kNotZero) << offset;
  }
}

TEST(PoseMessage, WhatIsShorterIsTooShort) {
  const std::vector<std::byte> whole = bytes_of_message().bytes();
  for (std::size_t bytes = 0; bytes < whole.size(); ++bytes) {
    ASSERT_EQ(decode(std::span(whole).first(bytes)).fate, Fate::kTooShort) << bytes;
  }
}

TEST(PoseMessage, NoFlippedBitPasses) {
  const std::vector<std::byte> whole = bytes_of_message().bytes();
  for (std::size_t bit = 0; bit < whole.size() * 8; ++bit) {
    std::vector<std::byte> spoilt = whole;
    spoilt.at(bit / 8) ^= std::byte{1} << (bit % 8);
    ASSERT_NE(decode(spoilt).fate, Fate::kUsed) << bit;
  }
}

// Random fields: whatever is sound comes back as it was sent, and nothing else is sound.
TEST(PoseMessage, ComesBackAsItWasSent) {
  tests::Random random(5);
  Encoder encoder;
  int sound = 0;
  for (int i = 0; i < 2'000; ++i) {
    Message message{.run = static_cast<std::uint32_t>(random.next()),
                    .age_us = static_cast<std::uint32_t>(random.between(0, 220'000)),
                    .clock_us = random.next() >> 1U,
                    .pose = {random.between(-1'050'000'000, 1'050'000'000), 5,
                             static_cast<std::uint32_t>(random.next())},
                    .sigma = {static_cast<std::uint16_t>(random.below(4)), 9},
                    .speed_mm_per_s = random.between(-110'000, 110'000)};
    if (random.one_in(2)) {
      message.map = MapTransform{.origin = random.next(), .sigma = {1, 1}};
    }
    const bool is_sound = message.age_us <= 200'000 && message.clock_us >> 62U == 0 &&
                          message.sigma.position_mm > 0 &&
                          std::abs(message.pose.x_mm) <= 1'000'000'000 &&
                          std::abs(message.speed_mm_per_s) <= 100'000;
    const Decoded decoded = decode(encoder.encode(message));
    ASSERT_EQ(decoded.fate == Fate::kUsed, is_sound);
    ASSERT_TRUE(!is_sound || decoded.message == message);
    sound += is_sound ? 1 : 0;
  }
  EXPECT_GT(sound, 500);
  EXPECT_LT(sound, 1'500);
}

}  // namespace
}  // namespace iog::pose
