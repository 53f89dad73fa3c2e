// Messages with a MAC: their bytes against OpenSSL's, and who is believed.
#include "authentication/secured_message.hpp"

#include <gtest/gtest.h>

#include "blocks.hpp"

namespace iog::authentication {
namespace {

using testing::from_hex;

using Bytes = std::vector<std::byte>;

constexpr std::uint16_t kPoses = 0x8003;
constexpr std::uint16_t kMaps = 0x8004;
constexpr std::uint32_t kRun = 0x1234ABCD;

// Event 0x8003 with four bytes of content, by tests/e2e/protected_message.py.
Bytes plain_message() {
  return from_hex("4f478003 00000018 00000001 01010200 00180000 494f4703 d981055e deadbeef");
}

// The same with counter 7 for that run, by `openssl mac` of OpenSSL 3.0.
Bytes signed_message() {
  return from_hex(
      "4f478003 00000024 00000001 01010200 00180000 494f4703 d981055e deadbeef"
      "00000007 fcfa3761383e66e5");
}

Bytes signed_with(std::uint32_t counter, std::uint32_t run = kRun, std::uint16_t kind = kPoses) {
  const CmacKey key(testing::example_key());
  Bytes secured = plain_message();
  secured.resize(secured.size() + kTrailerBytes);
  sign(key, kind, {.run = run, .counter = counter}, secured);
  return secured;
}

class SecuredMessage : public ::testing::Test {
 protected:
  CmacKey key_{testing::example_key()};
  Verifier verifier_{key_, kPoses, kRun};
};

TEST_F(SecuredMessage, HasTheBytesOfOpenSsl) {
  EXPECT_EQ(signed_with(7), signed_message());
  EXPECT_EQ(verifier_.verify(signed_message()), Verdict::kAuthentic);
  EXPECT_EQ(verifier_.counter(), 7U);
}

TEST_F(SecuredMessage, IsThePlainOneBehindTheMac) {
  const Bytes secured = signed_message();
  Bytes message(secured.size() - kTrailerBytes);
  strip(secured, message);
  EXPECT_EQ(message, plain_message());
  EXPECT_TRUE(is_signed(secured));
  EXPECT_FALSE(is_signed(message));
}

// Header, protection and trailer, nothing between: both lengths say so (docs/spec.md 9).
TEST_F(SecuredMessage, OneWithoutContentIsSignedToo) {
  const Bytes secured = from_hex(
      "4f478003 00000020 00000001 01010200 00140000 494f4703 00000000"
      "00000007 0000000000000000");
  EXPECT_TRUE(is_signed(secured));
  for (std::size_t bytes = 0; bytes < secured.size(); ++bytes) {
    EXPECT_FALSE(is_signed(std::span(secured).first(bytes))) << bytes;
  }
}

TEST_F(SecuredMessage, OneWithoutAMacIsUnsigned) {
  EXPECT_EQ(verifier_.verify(plain_message()), Verdict::kUnsigned);
  EXPECT_EQ(verifier_.verify({}), Verdict::kUnsigned);
  Bytes longer = signed_message();
  longer.push_back(std::byte{0});
  EXPECT_EQ(verifier_.verify(longer), Verdict::kUnsigned);
  Bytes much_longer(kMostSecuredBytes + 1);
  EXPECT_EQ(verifier_.verify(much_longer), Verdict::kUnsigned);
  const Bytes secured = signed_message();
  for (std::size_t bytes = 0; bytes < secured.size(); ++bytes) {
    EXPECT_EQ(verifier_.verify(std::span(secured).first(bytes)), Verdict::kUnsigned) << bytes;
  }
}

TEST_F(SecuredMessage, IsNotBelievedTwice) {
  EXPECT_EQ(verifier_.verify(signed_with(7)), Verdict::kAuthentic);
  EXPECT_EQ(verifier_.verify(signed_with(7)), Verdict::kReplayed);
  EXPECT_EQ(verifier_.verify(signed_with(6)), Verdict::kReplayed);
  EXPECT_EQ(verifier_.verify(signed_with(8)), Verdict::kAuthentic);
  EXPECT_EQ(verifier_.verify(signed_with(0xFFFFFFFF)), Verdict::kAuthentic) << "some were lost";
  EXPECT_EQ(verifier_.verify(signed_with(0)), Verdict::kReplayed) << "it does not wrap";
}

TEST_F(SecuredMessage, ACounterOfZeroIsNone) {
  EXPECT_EQ(verifier_.verify(signed_with(0)), Verdict::kReplayed);
}

TEST_F(SecuredMessage, OfAnotherRunKindOrKeyIsForged) {
  EXPECT_EQ(verifier_.verify(signed_with(7, kRun - 1)), Verdict::kForged) << "before the reset";
  EXPECT_EQ(verifier_.verify(signed_with(7, kRun, kMaps)), Verdict::kForged);
  const CmacKey other(Key{});
  EXPECT_EQ(Verifier(other, kPoses, kRun).verify(signed_message()), Verdict::kForged);
  EXPECT_EQ(verifier_.counter(), 0U) << "what is forged changes nothing";
  EXPECT_EQ(verifier_.verify(signed_message()), Verdict::kAuthentic);
}

// By `openssl mac` of OpenSSL 3.0: of 80011234abcd 00000007 00000000 ffffffff.
TEST_F(SecuredMessage, WhatTheTargetCountsIsSigned) {
  const std::array<std::uint32_t, 3> counters{7, 0, 0xFFFFFFFF};
  EXPECT_EQ(mac_of_counters(key_, 0x8001, kRun, counters),
            (std::array<std::uint32_t, 2>{0xFDB60452, 0xA2A0DD4F}));
}

// Bytes 0 to 3, the message id, are the business of whoever reads it; the data id stands for them.
TEST_F(SecuredMessage, EveryBitIsCovered) {
  const Bytes secured = signed_message();
  for (std::size_t bit = 32; bit < 8 * secured.size(); ++bit) {
    Bytes changed = secured;
    changed.at(bit / 8) ^= static_cast<std::byte>(1U << bit % 8);
    Verifier verifier(key_, kPoses, kRun);
    EXPECT_NE(verifier.verify(changed), Verdict::kAuthentic) << bit;
    EXPECT_EQ(verifier.counter(), 0U);
  }
}

}  // namespace
}  // namespace iog::authentication
