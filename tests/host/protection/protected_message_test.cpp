#include "protection/protected_message.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "wire/byte_order.hpp"

namespace iog::protection {
namespace {

using Bytes = std::vector<std::byte>;

constexpr Channel kChannel{
    .event = {.service_id = 0x1234, .event_id = 0x8001, .interface_version = 3},
    .data_id = 0x0A0B0C0D,
    .max_delta_counter = 4};

Bytes message_with(std::size_t content_bytes) {
  Bytes message(kProtectionBytes + content_bytes);
  std::ranges::fill(message, std::byte{0x5A});
  return message;
}

Bytes sent(Sender& sender, std::size_t content_bytes = 100) {
  Bytes message = message_with(content_bytes);
  sender.protect(message);
  return message;
}

// PRS_SOMEIPProtocol, "Header": the fields of a notification.
TEST(SomeIp, TheHeaderIsAsTheStandardSays) {
  Sender sender(kChannel);
  const Bytes message = sent(sender);
  const std::vector<int> expected{0x12, 0x34, 0x80, 0x01, 0, 0, 0, 120, 0, 0, 0, 1, 1, 3, 2, 0};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(std::to_integer<int>(message.at(i)), expected.at(i)) << i;
  }
}

TEST(SomeIp, SessionsCountFromOneAndSkipZero) {
  Sender sender(kChannel);
  for (int i = 1; i <= 0xFFFF; ++i) {
    const Bytes message = sent(sender, 0);
    ASSERT_EQ(wire::load_be16(std::span(message).subspan<10, 2>()), i);
  }
  const Bytes after = sent(sender, 0);
  EXPECT_EQ(wire::load_be16(std::span(after).subspan<10, 2>()), 1);
}

// Of a message that carries nothing the standard's example is left, but for the upper header.
TEST(ProtectedMessage, TheTwoLengthsCountTheSameBytes) {
  Sender sender(kChannel);
  const Bytes message = sent(sender, 4);
  EXPECT_EQ(wire::load_be32(std::span(message).subspan<4, 4>()), 24U);
  EXPECT_EQ(wire::load_be16(std::span(message).subspan<16, 2>()), 24U);
}

TEST(ProtectedMessage, ArrivesAsItWasSent) {
  Sender sender(kChannel);
  Receiver receiver(kChannel);
  for (std::size_t bytes : {std::size_t{0}, std::size_t{1}, kMaxContentBytes}) {
    const Bytes message = sent(sender, bytes);
    const Received received = receiver.receive(message);
    ASSERT_EQ(received.header, SomeIpStatus::kOk);
    ASSERT_EQ(received.check, CheckStatus::kOk);
    ASSERT_EQ(received.content.size(), bytes);
    ASSERT_EQ(std::ranges::count(received.content, std::byte{0x5A}),
              static_cast<std::ptrdiff_t>(bytes));
  }
  static_assert(kSomeIpHeaderBytes + 1392 > kMaxMessageBytes, "SOME/IP's payload is below 1392");
}

// Which bytes the CRC covers: from the request id on, but for itself. What stands before is checked
// against the channel and the datagram, so no flipped bit passes.
TEST(ProtectedMessage, NoFlippedBitPasses) {
  Sender sender(kChannel);
  const Bytes message = sent(sender, 40);
  Receiver receiver(kChannel);
  for (std::size_t bit = 0; bit < message.size() * 8; ++bit) {
    Bytes damaged = message;
    damaged.at(bit / 8) ^= std::byte{1} << (bit % 8);
    const Received received = receiver.receive(damaged);
    ASSERT_TRUE(received.header != SomeIpStatus::kOk || received.check == CheckStatus::kError);
    ASSERT_TRUE(received.content.empty());
    const bool is_session = bit / 8 == 10 || bit / 8 == 11;
    ASSERT_TRUE(!is_session || received.check == CheckStatus::kError)
        << "the request id is covered";
  }
  EXPECT_EQ(receiver.receive(message).check, CheckStatus::kOk);
}

TEST(ProtectedMessage, StrangersAreToldApart) {
  Sender sender(kChannel);
  const Bytes message = sent(sender, 40);
  Receiver receiver(kChannel);
  const auto header_with = [&](std::size_t at, int value) {
    Bytes changed = message;
    changed.at(at) = static_cast<std::byte>(value);
    return receiver.receive(changed).header;
  };
  EXPECT_EQ(header_with(1, 0x35), SomeIpStatus::kNotOurs);
  EXPECT_EQ(header_with(3, 0x02), SomeIpStatus::kNotOurs);
  EXPECT_EQ(header_with(7, 61), SomeIpStatus::kTooShort);
  EXPECT_EQ(header_with(7, 59), SomeIpStatus::kTooLong);
  EXPECT_EQ(header_with(4, 0xFF), SomeIpStatus::kTooShort);
  EXPECT_EQ(header_with(12, 2), SomeIpStatus::kNotOurs) << "another SOME/IP";
  EXPECT_EQ(header_with(13, 4), SomeIpStatus::kWrongVersion);
  EXPECT_EQ(header_with(14, 0x80), SomeIpStatus::kWrongType);
  EXPECT_EQ(header_with(15, 1), SomeIpStatus::kWrongType);
  for (std::size_t size = 0; size < message.size(); ++size) {
    ASSERT_EQ(receiver.receive(std::span(message).first(size)).header, SomeIpStatus::kTooShort);
  }
}

TEST(ProtectedMessage, AnotherVersionOfTheInterfaceIsNamed) {
  Sender sender(kChannel);
  Bytes message = sent(sender, 40);
  Receiver receiver(kChannel);
  EXPECT_EQ(receiver.receive(message).interface_version, 0);
  for (const int version : {1, 2, 4, 255}) {
    message.at(13) = static_cast<std::byte>(version);
    const Received received = receiver.receive(message);
    EXPECT_EQ(received.header, SomeIpStatus::kWrongVersion);
    EXPECT_EQ(received.interface_version, version);
    EXPECT_TRUE(received.content.empty());
  }
}

// Loss, repetition and exchange of messages, as a receiver sees them.
TEST(ProtectedMessage, TheReceiverSeesWhatTheLinkDid) {
  Sender sender(kChannel);
  std::vector<Bytes> messages;
  messages.reserve(10);
  for (int i = 0; i < 10; ++i) {
    messages.push_back(sent(sender));
  }
  Receiver receiver(kChannel);
  const auto check_of = [&](std::size_t i) { return receiver.receive(messages.at(i)).check; };
  EXPECT_EQ(check_of(0), CheckStatus::kOk);
  EXPECT_EQ(check_of(2), CheckStatus::kOkSomeLost);
  EXPECT_EQ(check_of(2), CheckStatus::kRepeated);
  EXPECT_EQ(check_of(1), CheckStatus::kWrongSequence);
  EXPECT_EQ(check_of(8), CheckStatus::kWrongSequence) << "seven ahead of the last, four allowed";
  EXPECT_EQ(check_of(9), CheckStatus::kOk);
}

// It knows nothing of the counter, so one message is lost to it.
TEST(ProtectedMessage, WhoeverJoinsLateIsInSequenceAtTheSecondMessage) {
  Sender sender(kChannel);
  for (int i = 0; i < 1'000; ++i) {
    static_cast<void>(sent(sender, 0));
  }
  Receiver receiver(kChannel);
  EXPECT_EQ(receiver.receive(sent(sender)).check, CheckStatus::kWrongSequence);
  EXPECT_EQ(receiver.receive(sent(sender)).check, CheckStatus::kOk);
}

}  // namespace
}  // namespace iog::protection
