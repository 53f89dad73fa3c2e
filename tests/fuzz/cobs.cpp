// A line of any bytes through the decoder, and its bytes as a message through the encoder.
#include "framing/cobs.hpp"

#include <algorithm>
#include <array>
#include <vector>

#include "law.hpp"

namespace iog::fuzz {
namespace {

using Bytes = std::vector<std::byte>;
using Messages = std::vector<Bytes>;

Messages messages_of(std::span<const std::byte> line, framing::CobsDecoder& decoder) {
  Messages messages;
  for (const std::byte byte : line) {
    if (const auto message = decoder.decode(byte)) {
      messages.emplace_back(message->begin(), message->end());
    }
  }
  return messages;
}

Bytes frame_of(std::span<const std::byte> message) {
  Bytes frame(framing::max_framed_bytes(message.size()));
  frame.resize(framing::encode_cobs(message, frame));
  law(!frame.empty() && frame.back() == framing::kDelimiter &&
          std::ranges::count(frame, framing::kDelimiter) == 1,
      "a frame has its delimiter at its end and nowhere else");
  return frame;
}

void check_message(std::span<const std::byte> message) {
  Bytes buffer(message.size());
  framing::CobsDecoder decoder(buffer);
  const Messages received = messages_of(frame_of(message), decoder);
  law(received.size() == 1 && std::ranges::equal(received[0], message), "a message comes back");
}

void check_line(std::span<const std::byte> line) {
  std::array<std::byte, 64> buffer{};
  framing::CobsDecoder used(buffer);
  const Messages messages = messages_of(line, used);
  const auto delimiters = std::ranges::count(line, framing::kDelimiter);
  law(messages.size() + used.damaged() <= static_cast<std::size_t>(delimiters),
      "no message without its delimiter");
  for (const Bytes& message : messages) {
    law(message.size() <= buffer.size(), "no message longer than the buffer");
    check_message(message);
  }
  static_cast<void>(used.decode(framing::kDelimiter));
  framing::CobsDecoder fresh(buffer);
  law(messages_of(line, used) == messages_of(line, fresh), "a delimiter ends all that was before");
}

}  // namespace

void check(std::span<const std::byte> input) {
  check_line(input);
  check_message(input);
}

}  // namespace iog::fuzz
