// Numbers a target's messages, protects them, and sends them to the network.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "app/platform.hpp"
#include "protection/protected_message.hpp"
#include "require/require.hpp"
#include "stream/channel.hpp"
#include "stream/message.hpp"

namespace iog::app {

template <Platform P>
class MessageSender {
 public:
  // `platform` must outlive this object.
  explicit MessageSender(P& platform) : platform_(&platform) {}

  // Returns the sequence number of the next message.
  [[nodiscard]] std::uint32_t sequence() const { return sequence_; }

  // Sends a complete message, which must begin with kProtectionBytes bytes for the protection
  // fields. Returns false if the network did not accept the message. Each lost message also uses up
  // a sequence number, so that the receiver can detect the loss.
  [[nodiscard]] bool send(std::span<std::byte> message, protection::TailRemainder tail = {}) {
    sender_.protect(message, tail);
    ++sequence_;
    return platform_->send_message(message);
  }

  // Sends a message with a header and a body. `write(buffer)` writes the body and returns its
  // length in bytes.
  template <typename Write>
  void send(stream::Header header, stream::MessageType type, Write&& write) {
    std::array<std::byte, protection::kMaxMessageBytes> message;
    const auto content = std::span<std::byte>(message).subspan(protection::kProtectionBytes);
    header.type = type;
    header.sequence = sequence_;
    const std::size_t head = stream::write_header(header, content);
    const std::size_t body = write(content.subspan(head));
    require(body > 0);
    static_cast<void>(send(std::span(message).first(protection::kProtectionBytes + head + body)));
  }

 private:
  P* platform_;
  std::uint32_t sequence_ = 0;
  protection::Sender sender_{stream::kNetworkChannel};
};

}  // namespace iog::app
