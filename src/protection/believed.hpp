// Decides whether a message is accepted. The sender must be allow-listed, and both headers must be
// valid.
#pragma once

#include <cstdint>

#include "protection/protected_message.hpp"

namespace iog::protection {

// Returns true if the source address `ipv4` may send. `described_ipv4` is the sender's address in
// the car file, or 0 if any address may send. The replayer may send on behalf of any sender. If
// there is no replayer, replayer_ipv4 is 0.
[[nodiscard]] constexpr bool may_send(std::uint32_t ipv4, std::uint32_t described_ipv4,
                                      std::uint32_t replayer_ipv4) {
  return described_ipv4 == 0 || described_ipv4 == ipv4 ||
         (replayer_ipv4 != 0 && replayer_ipv4 == ipv4);
}

// Returns the outcome of checking both headers as an enumerator of the caller's `Fate`: `sound`,
// kNotOurs, kWrongVersion or kDamaged. The order of messages is not checked.
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
