// The examples that AUTOSAR publishes, and each status of a check.
#include "protection/profile4.hpp"

#include <gtest/gtest.h>

#include "fakes/bytes_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::protection {
namespace {

using tests::Bytes;
using tests::bytes_of;

constexpr Profile4 kExample{.data_id = 0x0A0B0C0D, .offset_bytes = 0, .max_delta_counter = 1};
constexpr Profile4 kExampleWithOffset{
    .data_id = 0x0A0B0C0D, .offset_bytes = 8, .max_delta_counter = 1};

Bytes protected_zeros(Profile4Protector& protector, std::size_t bytes) {
  Bytes data(bytes);
  protector.protect(data);
  return data;
}

// PRS_E2EProtocol, "E2E Profile 4 Protocol Examples": data of zeros, data id 0x0A0B0C0D, counter 0;
// 16 bytes with the header at offset 0, and 24 bytes with it at offset 64 bits, as behind SOME/IP.
// What follows with counter 1 has the CRCs that the Python package autosar-e2e expects in its
// tests.
TEST(Profile4, ProtectsThePublishedExamples) {
  Profile4Protector protector(kExample);
  EXPECT_EQ(protected_zeros(protector, 16), bytes_of({0x00, 0x10, 0x00, 0x00, 0x0A, 0x0B, 0x0C,
                                                      0x0D, 0x86, 0x2B, 0x05, 0x56, 0, 0, 0, 0}));
  EXPECT_EQ(protected_zeros(protector, 16), bytes_of({0x00, 0x10, 0x00, 0x01, 0x0A, 0x0B, 0x0C,
                                                      0x0D, 0xA5, 0x8E, 0x68, 0x07, 0, 0, 0, 0}));
}

TEST(Profile4, ProtectsThePublishedExamplesBehindAnUpperHeader) {
  Profile4Protector protector(kExampleWithOffset);
  EXPECT_EQ(protected_zeros(protector, 24),
            bytes_of({0,    0,    0,    0,    0,    0,    0,    0,    0x00, 0x18, 0x00, 0x00,
                      0x0A, 0x0B, 0x0C, 0x0D, 0x69, 0xD7, 0x50, 0x2E, 0,    0,    0,    0}));
  EXPECT_EQ(protected_zeros(protector, 24),
            bytes_of({0,    0,    0,    0,    0,    0,    0,    0,    0x00, 0x18, 0x00, 0x01,
                      0x0A, 0x0B, 0x0C, 0x0D, 0x4A, 0x72, 0x3D, 0x7F, 0,    0,    0,    0}));
}

// A tail of which only the remainder is known gives the CRC that is computed from all bytes.
TEST(Profile4, ProtectsByTheRemainderOfTheTail) {
  using checksum::Crc32P4;
  tests::Random random(4);
  Profile4Protector reading(kExampleWithOffset);
  Profile4Protector knowing(kExampleWithOffset);
  for (std::size_t before = 20; before < 64; ++before) {
    Bytes data(before + Crc32P4::kPartBytes);
    for (std::byte& byte : data) {
      byte = static_cast<std::byte>(random.next());
    }
    Bytes expected = data;
    reading.protect(expected);
    const auto tail = std::span<const std::byte>(data).last<Crc32P4::kPartBytes>();
    knowing.protect(data, Crc32P4::remainder_of(tail));
    ASSERT_EQ(data, expected) << before;
  }
}

// A message of the example's sender, `count` counters after its first.
Bytes message_after(int count) {
  Profile4Protector protector(kExampleWithOffset);
  for (int i = 0; i < count; ++i) {
    protected_zeros(protector, 24);
  }
  return protected_zeros(protector, 24);
}

Profile4 allowing(std::uint16_t max_delta_counter) {
  Profile4 profile = kExampleWithOffset;
  profile.max_delta_counter = max_delta_counter;
  return profile;
}

TEST(Profile4Check, IsOkFromTheFirstCounterOn) {
  Profile4Checker checker(kExampleWithOffset);
  Profile4Protector protector(kExampleWithOffset);
  for (int i = 0; i < 100; ++i) {
    ASSERT_EQ(checker.check(protected_zeros(protector, 24)), CheckStatus::kOk);
  }
}

TEST(Profile4Check, TheCounterWraps) {
  Profile4Checker checker(kExampleWithOffset);
  Profile4Protector protector(kExampleWithOffset);
  for (int i = 0; i < 0x10000; ++i) {
    protected_zeros(protector, 20);
    static_cast<void>(i);
  }
  EXPECT_EQ(checker.check(protected_zeros(protector, 24)), CheckStatus::kOk);
}

TEST(Profile4Check, ARepeatedMessageIsSeen) {
  Profile4Checker checker(kExampleWithOffset);
  EXPECT_EQ(checker.check(message_after(0)), CheckStatus::kOk);
  EXPECT_EQ(checker.check(message_after(0)), CheckStatus::kRepeated);
  EXPECT_EQ(checker.check(message_after(1)), CheckStatus::kOk);
}

TEST(Profile4Check, LossesAreToleratedUpToTheLimitAndCounted) {
  Profile4Checker checker(allowing(5));
  EXPECT_EQ(checker.check(message_after(0)), CheckStatus::kOk);
  EXPECT_EQ(checker.check(message_after(2)), CheckStatus::kOkSomeLost);
  EXPECT_EQ(checker.delta_counter(), 2);
  EXPECT_EQ(checker.check(message_after(7)), CheckStatus::kOkSomeLost);
  EXPECT_EQ(checker.delta_counter(), 5);
  EXPECT_EQ(checker.check(message_after(13)), CheckStatus::kWrongSequence);
  EXPECT_EQ(checker.check(message_after(14)), CheckStatus::kOk);
}

TEST(Profile4Check, WhatComesLateIsOutOfSequence) {
  Profile4Checker checker(allowing(100));
  EXPECT_EQ(checker.check(message_after(0)), CheckStatus::kOk);
  EXPECT_EQ(checker.check(message_after(2)), CheckStatus::kOkSomeLost);
  EXPECT_EQ(checker.check(message_after(1)), CheckStatus::kWrongSequence);
  EXPECT_EQ(checker.check(message_after(3)), CheckStatus::kOkSomeLost);
}

TEST(Profile4Check, EveryFlippedBitAndEveryOtherLengthIsAnError) {
  const Bytes message = message_after(0);
  Profile4Checker checker(kExampleWithOffset);
  for (std::size_t bit = 0; bit < message.size() * 8; ++bit) {
    Bytes damaged = message;
    damaged.at(bit / 8) ^= std::byte{1} << (bit % 8);
    ASSERT_EQ(checker.check(damaged), CheckStatus::kError) << bit;
  }
  for (std::size_t size = 0; size < message.size(); ++size) {
    ASSERT_EQ(checker.check(std::span(message).first(size)), CheckStatus::kError);
  }
  Bytes longer = message;
  longer.push_back(std::byte{0});
  EXPECT_EQ(checker.check(longer), CheckStatus::kError);
  EXPECT_EQ(checker.check(message), CheckStatus::kOk) << "an error leaves the state as it was";
}

TEST(Profile4Check, AMessageOfAnotherDataIdIsAnError) {
  Profile4 other = kExampleWithOffset;
  other.data_id = 0x0A0B0C0E;
  Profile4Protector stranger(other);
  Profile4Checker checker(kExampleWithOffset);
  EXPECT_EQ(checker.check(protected_zeros(stranger, 24)), CheckStatus::kError);
}

TEST(Profile4Check, IsTotalOnGarbage) {
  tests::Random random(81);
  Profile4Checker checker(allowing(10));
  for (int i = 0; i < tests::effort(50'000, 1'000); ++i) {
    Bytes garbage(random.below(60));
    for (std::byte& byte : garbage) {
      byte = static_cast<std::byte>(random.next());
    }
    ASSERT_EQ(checker.check(garbage), CheckStatus::kError);
  }
}

}  // namespace
}  // namespace iog::protection
