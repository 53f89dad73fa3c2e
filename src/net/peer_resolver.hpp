// Remembers the peer's Ethernet address and says when to ask for it.
#pragma once

#include <cstdint>
#include <optional>

#include "net/address.hpp"

namespace iog::net {

// RFC 1122, section 2.3.2.1: no more than one ARP request per second to one destination.
inline constexpr std::uint64_t kArpRequestIntervalUs = 1'000'000;

// RFC 1122, section 2.3.2.1: an address that nobody has confirmed for this long is asked for again.
inline constexpr std::uint64_t kArpRefreshUs = 30'000'000;

// Time never goes backwards from call to call.
class PeerResolver {
 public:
  [[nodiscard]] bool known() const { return mac_.has_value(); }

  // Only when known(). An address is never forgotten, only replaced: a peer that is silent for a
  // while loses no message, and one that has gone costs one request a second.
  [[nodiscard]] const MacAddress& mac() const { return *mac_; }

  void learn(const MacAddress& mac, std::uint64_t now_us);

  // True if an ARP request is to be sent now, which then counts as asked. True at the first call,
  // as nothing is known then.
  [[nodiscard]] bool request_due(std::uint64_t now_us);

 private:
  std::optional<MacAddress> mac_;
  std::uint64_t learned_us_ = 0;
  std::optional<std::uint64_t> asked_us_;
};

}  // namespace iog::net
