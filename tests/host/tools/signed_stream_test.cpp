// A receiver that has its target's key believes what was signed with it, once, whatever the network
// does to the order.
#include "tools/frames/signed_stream.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "stream/channel.hpp"

namespace iog::tools {
namespace {

using Bytes = std::vector<std::byte>;

constexpr authentication::Key kKey{std::byte{1}, std::byte{2}, std::byte{3}};
constexpr authentication::Key kOtherKey{std::byte{1}, std::byte{2}, std::byte{4}};

// A message of a target; all that is looked at is that they differ.
Bytes message_of(unsigned number) {
  return {std::byte{0x4F},
          std::byte{0x47},
          std::byte{0x80},
          std::byte{0x01},
          static_cast<std::byte>(number >> 8),
          static_cast<std::byte>(number)};
}

// Signs messages in order.
class Target {
 public:
  explicit Target(std::uint32_t run, const authentication::Key& key = kKey)
      : key_(key), signer_(key_, stream::kSignatureChannel, run) {}

  Bytes signature_of(const std::vector<Bytes>& messages) {
    std::ranges::for_each(messages, [&](const Bytes& message) { signer_.add(message); });
    const std::span<const std::byte> signature = signer_.sign();
    return {signature.begin(), signature.end()};
  }

 private:
  authentication::CmacKey key_;
  authentication::StreamSigner signer_;
};

class Receiver {
 public:
  void take(const Bytes& datagram) {
    stream_.take(datagram, [this](std::span<const std::byte> message) {
      passed_.emplace_back(message.begin(), message.end());
    });
  }
  void take(const std::vector<Bytes>& datagrams) {
    std::ranges::for_each(datagrams, [&](const Bytes& datagram) { take(datagram); });
  }

  // What has been believed since the last call.
  std::vector<Bytes> passed() { return std::exchange(passed_, {}); }
  [[nodiscard]] SignedStream& stream() { return stream_; }

 private:
  SignedStream stream_{kKey};
  std::vector<Bytes> passed_;
};

TEST(SignedStream, MessagesWaitForTheirSignature) {
  Target target(7);
  Receiver receiver;
  const std::vector<Bytes> messages{message_of(1), message_of(2), message_of(3)};
  receiver.take(messages);
  EXPECT_TRUE(receiver.passed().empty());
  receiver.take(target.signature_of(messages));
  EXPECT_EQ(receiver.passed(), messages);
  EXPECT_EQ(receiver.stream().signatures(), 1U);
}

TEST(SignedStream, TheOrderOfArrivalIsNoMatter) {
  Target target(7);
  Receiver receiver;
  const std::vector<Bytes> messages{message_of(1), message_of(2), message_of(3)};
  const Bytes first = target.signature_of(messages);
  const std::vector<Bytes> later{message_of(4), message_of(5)};
  const Bytes second = target.signature_of(later);
  receiver.take({messages[2], messages[0]});
  receiver.take(first);
  EXPECT_EQ(receiver.passed(), (std::vector<Bytes>{messages[0], messages[2]}));
  receiver.take(second);
  receiver.take(later[1]);
  receiver.take(messages[1]);
  EXPECT_EQ(receiver.passed(), (std::vector<Bytes>{later[1], messages[1]}));
  receiver.take(later[0]);
  EXPECT_EQ(receiver.passed(), std::vector<Bytes>(1, later[0]));
  receiver.stream().finish();
  EXPECT_EQ(receiver.stream().unsigned_messages(), 0U);
}

// Of what is forged nothing is believed, and what is authentic is, all the same.
TEST(SignedStream, WhatNobodyHasSignedIsDropped) {
  Target target(7);
  Target stranger(7, kOtherKey);
  Receiver receiver;
  const std::vector<Bytes> messages{message_of(1), message_of(2)};
  const std::vector<Bytes> forged{message_of(3), message_of(4)};
  receiver.take(forged);
  receiver.take(messages);
  receiver.take(stranger.signature_of(forged));
  EXPECT_TRUE(receiver.passed().empty());
  EXPECT_EQ(receiver.stream().forged_signatures(), 1U);
  receiver.take(target.signature_of(messages));
  EXPECT_EQ(receiver.passed(), messages);
  receiver.stream().finish();
  EXPECT_EQ(receiver.stream().unsigned_messages(), 2U);
}

// What was believed once is not again: neither message nor signature, and of a run that has ended
// neither.
TEST(SignedStream, WhatComesTwiceIsBelievedOnce) {
  Target target(7);
  Receiver receiver;
  const std::vector<Bytes> messages{message_of(1), message_of(2)};
  const Bytes signature = target.signature_of(messages);
  receiver.take(messages);
  receiver.take(signature);
  EXPECT_EQ(receiver.passed(), messages);
  Target next(8);
  const std::vector<Bytes> of_next(1, message_of(9));
  receiver.take(of_next);
  receiver.take(next.signature_of(of_next));
  EXPECT_EQ(receiver.passed(), of_next);
  receiver.take(messages);
  receiver.take(signature);
  EXPECT_TRUE(receiver.passed().empty());
  EXPECT_EQ(receiver.stream().forged_signatures(), 1U);
  receiver.stream().finish();
  EXPECT_EQ(receiver.stream().unsigned_messages(), 2U);
}

// Its messages are not signed for ever, and those of the next are.
TEST(SignedStream, ASignatureThatIsLostTakesItsMessagesAlong) {
  Target target(7);
  Receiver receiver;
  for (unsigned frame = 0; frame < 40; ++frame) {
    const std::vector<Bytes> messages{message_of(2 * frame), message_of(2 * frame + 1)};
    receiver.take(messages);
    const Bytes signature = target.signature_of(messages);
    if (frame != 3) {
      receiver.take(signature);
    }
    EXPECT_EQ(receiver.passed(), frame != 3 ? messages : std::vector<Bytes>{}) << frame;
  }
  EXPECT_EQ(receiver.stream().unsigned_messages(), 2U);
}

// A flood of what nobody has signed takes a bounded room.
TEST(SignedStream, AFloodIsGivenUp) {
  Target target(7);
  Receiver receiver;
  for (unsigned number = 0; number < 5'000; ++number) {
    receiver.take(message_of(number));
  }
  EXPECT_EQ(receiver.stream().unsigned_messages(), 5'000U - 2'048U);
  const std::vector<Bytes> messages(1, message_of(60'000));
  receiver.take(messages);
  receiver.take(target.signature_of(messages));
  EXPECT_EQ(receiver.passed(), messages);
}

TEST(SignedStream, ARecordingThatIsPlayedAgainIsBelievedAgain) {
  Target target(7);
  Receiver receiver;
  const std::vector<Bytes> messages{message_of(1), message_of(2)};
  const Bytes signature = target.signature_of(messages);
  for (int turn = 0; turn < 3; ++turn) {
    receiver.take(messages);
    receiver.take(signature);
    EXPECT_EQ(receiver.passed(), messages);
    receiver.stream().forget();
  }
}

}  // namespace
}  // namespace iog::tools
