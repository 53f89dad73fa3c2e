// A stream of messages whose sender is proved (docs/spec.md 9.2). Behind some messages comes one
// that names them, and carries a MAC as a command does (authentication/secured_message.hpp). So a
// message is as it is without a key, and hashing it takes a tenth of what a MAC of it would.
//
// The content of a signature, big endian:
//
//    0  u16 bytes before the names, 12; u16 bytes of a name, 16
//    4  u32 number of the target's run
//    8  u16 number of names; u16 0
//   12  a name a message, in the order of sending: the first 128 bits of its SHA-256, all of its
//       bytes
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

// Knowing a message and its name, one needs 2^128 trials for another message of that name.
using MessageName = std::array<std::byte, 16>;

inline constexpr std::size_t kNamesHeaderBytes = 12;
inline constexpr std::size_t kMaxNames = 80;

[[nodiscard]] MessageName name_of(std::span<const std::byte> message);

class StreamSigner {
 public:
  // The key outlives it. The data id of the MAC is the channel's event.
  StreamSigner(const CmacKey& key, const protection::Channel& channel, std::uint32_t run)
      : key_(&key), data_id_(channel.event.event_id), run_(run), sender_(channel) {}

  // A message that is sent. Only if it is not full.
  void add(std::span<const std::byte> message);

  [[nodiscard]] bool is_full() const { return count_ == kMaxNames; }

  // The signature of what was added since the last one, at least one message. Valid until the next.
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

// What a signature says, whoever has made it.
struct Names {
  std::uint32_t run = 0;
  std::span<const std::byte> bytes{};

  [[nodiscard]] std::size_t count() const { return bytes.size() / sizeof(MessageName); }
  // Below count().
  [[nodiscard]] MessageName operator[](std::size_t i) const {
    MessageName name;
    std::ranges::copy(bytes.subspan(i * sizeof(MessageName), sizeof(MessageName)), name.begin());
    return name;
  }
};

// Of a secured message (is_signed()). Nothing: its numbers contradict each other.
[[nodiscard]] std::optional<Names> read_names(std::span<const std::byte> secured);

}  // namespace iog::authentication
