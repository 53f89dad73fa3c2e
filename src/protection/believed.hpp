// Whose messages are believed, and what becomes of the others.
#pragma once

#include <cstdint>

#include "protection/protected_message.hpp"

namespace iog::protection {

// By its address: the described sender's, 0: any; or that of the replayer, which may send in
// the name of every sender, 0: none.
[[nodiscard]] constexpr bool may_send(std::uint32_t ipv4, std::uint32_t described_ipv4,
                                      std::uint32_t replayer_ipv4) {
  return described_ipv4 == 0 || described_ipv4 == ipv4 ||
         (replayer_ipv4 != 0 && replayer_ipv4 == ipv4);
}

// By both headers, in the words of whoever takes the message: `sound`, or kNotOurs, kWrongVersion
// or kDamaged. In which order messages come is not asked.
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
