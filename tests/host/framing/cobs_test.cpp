// The frames of Cheshire and Baker (1999), and what a line does to them.
#include "framing/cobs.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "fakes/bytes_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"

namespace iog::framing {
namespace {

using tests::Bytes;
using tests::bytes_of;
using tests::joined;

// first, first + 1 ... last, modulo 256
Bytes counting(int first, int last) {
  Bytes bytes;
  for (int value = first; value <= last; ++value) {
    bytes.push_back(static_cast<std::byte>(value));
  }
  return bytes;
}

Bytes frame_of(const Bytes& message) {
  Bytes frame(max_framed_bytes(message.size()), std::byte{0xA5});  // what was there before
  frame.resize(encode_cobs(message, frame));
  return frame;
}

// The messages of a line.
std::vector<Bytes> messages_of(const Bytes& line, CobsDecoder& decoder) {
  std::vector<Bytes> messages;
  for (const std::byte byte : line) {
    if (const auto message = decoder.decode(byte)) {
      messages.emplace_back(message->begin(), message->end());
    }
  }
  return messages;
}

std::vector<Bytes> messages_of(const Bytes& line) {
  Bytes buffer(2'000);
  CobsDecoder decoder(buffer);
  return messages_of(line, decoder);
}

// Figures 2 and 3 of the paper, and the examples of Wikipedia's article with their delimiters.
TEST(Cobs, FramesAreThePublishedOnes) {
  const std::vector<std::pair<Bytes, Bytes>> examples{
      {{}, bytes_of({1, 0})},
      {bytes_of({0}), bytes_of({1, 1, 0})},
      {bytes_of({0, 0}), bytes_of({1, 1, 1, 0})},
      {bytes_of({0, 0x11, 0}), bytes_of({1, 2, 0x11, 1, 0})},
      {bytes_of({0x11, 0x22, 0, 0x33}), bytes_of({3, 0x11, 0x22, 2, 0x33, 0})},
      {bytes_of({0x11, 0x22, 0x33, 0x44}), bytes_of({5, 0x11, 0x22, 0x33, 0x44, 0})},
      {bytes_of({0x11, 0, 0, 0}), bytes_of({2, 0x11, 1, 1, 1, 0})},
      {counting(1, 254), joined({bytes_of({0xFF}), counting(1, 254), bytes_of({0})})},
      {counting(0, 254), joined({bytes_of({1, 0xFF}), counting(1, 254), bytes_of({0})})},
      {counting(1, 255), joined({bytes_of({0xFF}), counting(1, 254), bytes_of({2, 0xFF, 0})})},
      {joined({counting(2, 255), bytes_of({0})}),
       joined({bytes_of({0xFF}), counting(2, 255), bytes_of({1, 1, 0})})},
      {joined({counting(3, 255), bytes_of({0, 1})}),
       joined({bytes_of({0xFE}), counting(3, 255), bytes_of({2, 1, 0})})},
  };
  for (const auto& [message, frame] : examples) {
    EXPECT_EQ(frame_of(message), frame);
    EXPECT_EQ(messages_of(frame), std::vector<Bytes>{message});
  }
}

Bytes random_message(tests::Random& random, int max_bytes) {
  Bytes message(static_cast<std::size_t>(random.between(0, max_bytes)));
  const int zero_rate = random.between(1, 400);
  for (std::byte& byte : message) {
    byte = random.one_in(zero_rate) ? kDelimiter : static_cast<std::byte>(random.between(1, 255));
  }
  return message;
}

TEST(Cobs, EveryMessageSurvivesTheLine) {
  tests::Random random(71);
  for (int i = 0; i < tests::effort(2'000, 100); ++i) {
    const Bytes message = random_message(random, 1'400);
    const Bytes frame = frame_of(message);
    ASSERT_LE(frame.size(), max_framed_bytes(message.size()));
    ASSERT_EQ(std::ranges::count(frame, kDelimiter), 1);
    ASSERT_EQ(frame.back(), kDelimiter);
    ASSERT_EQ(messages_of(frame), std::vector<Bytes>{message});
  }
}

TEST(Cobs, AShorterBufferIsRefused) {
  const Bytes message = joined({counting(0, 255), counting(0, 255)});
  const Bytes frame = frame_of(message);
  for (std::size_t size = 0; size < frame.size(); ++size) {
    Bytes buffer(size);
    ASSERT_EQ(encode_cobs(message, buffer), 0U);
  }
}

// Whatever is lost or spoilt, what stands behind the next delimiter is not touched.
TEST(Cobs, TheReceiverFindsItsPlaceAtTheNextDelimiter) {
  tests::Random random(72);
  for (int i = 0; i < tests::effort(2'000, 100); ++i) {
    Bytes line = frame_of(random_message(random, 600));
    const auto at = static_cast<std::ptrdiff_t>(random.below(line.size()));
    if (random.one_in(2)) {
      line.erase(line.begin() + at);
    } else {
      line.at(static_cast<std::size_t>(at)) = static_cast<std::byte>(random.next());
    }
    const Bytes next = random_message(random, 600);
    line = joined({line, frame_of(bytes_of({1})), frame_of(next)});
    const std::vector<Bytes> received = messages_of(line);
    ASSERT_FALSE(received.empty());
    ASSERT_EQ(received.back(), next);
  }
}

TEST(Cobs, ALostDelimiterSpoilsTheMessagesOnItsSidesAlone) {
  const Bytes line = bytes_of({3, 1, 2, /* 0, */ 2, 3, 0, 2, 4, 0});
  EXPECT_EQ(messages_of(line), (std::vector<Bytes>{bytes_of({1, 2, 0, 3}), bytes_of({4})}));
}

TEST(Cobs, WhatIsCutShortOrTooLongIsDroppedAndCounted) {
  Bytes buffer(4);
  CobsDecoder decoder(buffer);
  EXPECT_TRUE(messages_of(bytes_of({5, 1, 2, 0}), decoder).empty());
  EXPECT_EQ(decoder.damaged(), 1U);
  EXPECT_TRUE(messages_of(bytes_of({6, 1, 2, 3, 4, 5, 0}), decoder).empty());
  EXPECT_EQ(decoder.damaged(), 2U);
  EXPECT_EQ(messages_of(bytes_of({5, 1, 2, 3, 4, 0}), decoder).size(), 1U);
  EXPECT_EQ(decoder.damaged(), 2U);
}

TEST(Cobs, NothingBetweenTwoDelimitersIsNoMessage) {
  EXPECT_EQ(messages_of(bytes_of({0, 0, 2, 7, 0, 0, 0})), std::vector<Bytes>{bytes_of({7})});
}

}  // namespace
}  // namespace iog::framing
