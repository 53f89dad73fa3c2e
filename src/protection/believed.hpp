// Decides whether a message is accepted: allow-listed source, and valid headers.
#pragma once

#include <cstdint>

#include "protection/protected_message.hpp"

namespace iog::protection {

// True if this source address may send. described_ipv4 is the sender in the car file, 0 for any.
// The replayer may send in the name of every sender; replayer_ipv4 is 0 if there is none.
[[nodiscard]] constexpr bool may_send(std::uint32_t ipv4, std::uint32_t described_ipv4,
                                      std::uint32_t replayer_ipv4) {
  return described_ipv4 == 0 || described_ipv4 == ipv4 ||
         (replayer_ipv4 != 0 && replayer_ipv4 == ipv4);
}

// The outcome after checking both headers: `sound`, kNotOurs, kWrongVersion or kDamaged, as an
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
