// Signs a stream of messages (docs/spec.md 9.2). Each group of messages is followed by a signature
// message. The signature message lists the names (truncated hashes) of the messages in the group.
// Like a command, it also contains a MAC (authentication/secured_message.hpp). The signed messages
// themselves do not change. Hashing the messages takes one tenth of the time that one MAC per
// message would take.
//
// The payload of a signature is in big-endian order:
//
//    `0`  The number of bytes before the names (u16), which is 12, and the number of bytes per name
//         (u16), which is 16.
//    `4`  The run number of the target (u32).
//    `8`  The number of names (u16), and 0 (u16).
//   `12`  One name per message, in sending order. A name is the first 128 bits of the SHA-256
//         hash of the whole message.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "authentication/secured_message.hpp"
#include "protection/protected_message.hpp"

namespace iog::authentication {

// A truncated hash of a message. Finding a second message with the same hash takes 2^128 attempts.
using MessageName = std::array<std::byte, 16>;

inline constexpr std::size_t kNamesHeaderBytes = 12;
inline constexpr std::size_t kMaxNames = 80;

[[nodiscard]] MessageName name_of(std::span<const std::byte> message);

class StreamSigner {
 public:
  // The key must outlive this object. The MAC's data ID is the channel's event ID.
  StreamSigner(const CmacKey& key, const protection::Channel& channel, std::uint32_t run)
      : key_(&key), data_id_(channel.event.event_id), run_(run), sender_(channel) {}

  // Adds a sent message. Requires !is_full().
  void add(std::span<const std::byte> message);

  [[nodiscard]] bool is_full() const { return count_ == kMaxNames; }

  // Returns the signature of the messages added since the last call. At least one message must have
  // been added. The result is valid until the next call.
  [[nodiscard]] std::span<const std::byte> sign();

 private:
  static constexpr std::size_t kMostBytes = protection::kProtectionBytes + kNamesHeaderBytes +
                                            kMaxNames * sizeof(MessageName) + kTrailerBytes;
  static_assert(kMostBytes <= protection::kMaxMessageBytes);

  const CmacKey* key_;
  std::uint16_t data_id_;
  std::uint32_t run_;
  protection::Sender sender_;
  std::uint32_t signatures_ = 0;
  std::size_t count_ = 0;
  std::array<MessageName, kMaxNames> names_{};
  std::array<std::byte, kMostBytes> message_{};
};

// The content of a signature that has not been verified yet.
struct Names {
  std::uint32_t run = 0;
  std::span<const std::byte> bytes{};

  [[nodiscard]] std::size_t count() const { return bytes.size() / sizeof(MessageName); }
  // Requires i < count().
  [[nodiscard]] MessageName operator[](std::size_t i) const {
    MessageName name;
    std::ranges::copy(bytes.subspan(i * sizeof(MessageName), sizeof(MessageName)), name.begin());
    return name;
  }
};

// Reads a secured message. Requires that is_signed() is true for the message. Returns nothing if
// the message's length fields or counts are inconsistent.
[[nodiscard]] std::optional<Names> read_names(std::span<const std::byte> secured);

}  // namespace iog::authentication
