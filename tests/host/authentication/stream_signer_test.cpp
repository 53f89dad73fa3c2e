// A signature names the messages before it, byte by byte as docs/spec.md 9.2 says.
#include "authentication/stream_signer.hpp"

#include <gtest/gtest.h>
#include <vector>

#include "blocks.hpp"

namespace iog::authentication {
namespace {

using testing::from_hex;

constexpr std::uint32_t kStreamRun = 0x1234ABCD;
constexpr protection::Channel kChannel{
    .event = {.service_id = 0x4F47, .event_id = 0x8005, .interface_version = 5},
    .data_id = 0x494F4705,
    .max_delta_counter = 512};

std::span<const std::byte> bytes_of(std::string_view text) {
  return std::as_bytes(std::span(text));
}

// The E2E CRC aside, of which protection's tests tell. The MAC is OpenSSL 3.0's, of the data id,
// the bytes from 8 on and the freshness value (openssl mac -cipher AES-128-CBC).
TEST(StreamSigner, NamesItsMessages) {
  const CmacKey key(testing::example_key());
  StreamSigner signer(key, kChannel, kStreamRun);
  signer.add(bytes_of("abc"));
  signer.add(bytes_of(""));
  const std::span<const std::byte> secured = signer.sign();
  const std::vector<std::byte> message(secured.begin(), secured.end());
  ASSERT_EQ(message.size(), 28U + 12U + 2U * 16U + 12U);
  const std::vector<std::byte> head(message.begin(), message.begin() + 24);
  EXPECT_EQ(head, from_hex("4f478005 0000004c 00000001 01050200 00400000 494f4705"));
  const std::vector<std::byte> content(message.begin() + 28, message.end() - 8);
  EXPECT_EQ(content, from_hex("000c0010 1234abcd 00020000"
                              "ba7816bf8f01cfea414140de5dae2223"
                              "e3b0c44298fc1c149afbf4c8996fb924"
                              "00000001"));
  const std::vector<std::byte> mac(message.end() - 8, message.end());
  EXPECT_EQ(mac, from_hex("dcf354e07548176e"));
}

TEST(StreamSigner, ASignatureIsVerifiedOnceInItsRunAndItsOrder) {
  const CmacKey key(testing::example_key());
  StreamSigner signer(key, kChannel, kStreamRun);
  Verifier verifier(key, 0x8005, kStreamRun);
  Verifier of_another_run(key, 0x8005, kStreamRun + 1);
  for (std::size_t count : {1U, 5U, 80U}) {
    std::vector<std::vector<std::byte>> messages;
    for (std::size_t i = 0; i < count; ++i) {
      messages.emplace_back(7 + i, std::byte{static_cast<unsigned char>(i)});
      ASSERT_FALSE(signer.is_full());
      signer.add(messages.back());
    }
    EXPECT_EQ(signer.is_full(), count == kMaxNames);
    const std::span<const std::byte> secured = signer.sign();
    EXPECT_FALSE(signer.is_full());
    EXPECT_EQ(of_another_run.verify(secured), Verdict::kForged);
    EXPECT_EQ(verifier.verify(secured), Verdict::kAuthentic);
    EXPECT_EQ(verifier.verify(secured), Verdict::kReplayed);
    const auto names = read_names(secured);
    ASSERT_TRUE(names);
    EXPECT_EQ(names->run, kStreamRun);
    ASSERT_EQ(names->count(), count);
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ((*names)[i], name_of(messages[i]));
    }
  }
}

// Each of its bits changed, and each byte cut off.
TEST(StreamSigner, WhatWasChangedIsNotAuthentic) {
  const CmacKey key(testing::example_key());
  StreamSigner signer(key, kChannel, kStreamRun);
  signer.add(bytes_of("abc"));
  const std::span<const std::byte> secured = signer.sign();
  for (std::size_t bit = 4 * 8; bit < secured.size() * 8; ++bit) {
    std::vector<std::byte> changed(secured.begin(), secured.end());
    changed[bit / 8] ^= std::byte{1} << (bit % 8);
    EXPECT_NE(Verifier(key, 0x8005, kStreamRun).verify(changed), Verdict::kAuthentic) << bit;
  }
  for (std::size_t bytes = 0; bytes < secured.size(); ++bytes) {
    EXPECT_NE(Verifier(key, 0x8005, kStreamRun).verify(secured.first(bytes)), Verdict::kAuthentic);
    EXPECT_FALSE(read_names(secured.first(bytes))) << bytes;
  }
}

}  // namespace
}  // namespace iog::authentication
