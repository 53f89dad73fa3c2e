// Decides whether a message is accepted: its source must be allow-listed, and its headers must be
// valid.
#pragma once

#include <cstdint>

#include "protection/protected_message.hpp"

namespace iog::protection {

// True if this source address may send. described_ipv4 is the sender's address in the car file, or
// 0 if any address may send. The replayer may send on behalf of every sender. replayer_ipv4 is 0 if
// there is no replayer.
[[nodiscard]] constexpr bool may_send(std::uint32_t ipv4, std::uint32_t described_ipv4,
                                      std::uint32_t replayer_ipv4) {
  return described_ipv4 == 0 || described_ipv4 == ipv4 ||
         (replayer_ipv4 != 0 && replayer_ipv4 == ipv4);
}

// The outcome of checking both headers: `sound`, kNotOurs, kWrongVersion or kDamaged, as an
// enumerator of the caller's Fate. The order of messages is not checked.
template <typename Fate>
[[nodiscard]] constexpr Fate fate_of(const Received& received, Fate sound) {
  switch (received.header) {
    case SomeIpStatus::kTooShort:
    case SomeIpStatus::kTooLong:
      return Fate::kDamaged;
    case SomeIpStatus::kNotOurs:
    case SomeIpStatus::kWrongType:
      return Fate::kNotOurs;
    case SomeIpStatus::kWrongVersion:
      return Fate::kWrongVersion;
    case SomeIpStatus::kOk:
      break;
  }
  return received.check == CheckStatus::kError ? Fate::kDamaged : sound;
}

}  // namespace iog::protection
