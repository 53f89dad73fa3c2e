// Remembers the Ethernet address of one host, here called the peer, and says when to ask for it.
#pragma once

#include <cstdint>
#include <optional>

#include "net/address.hpp"

namespace iog::net {

// RFC 1122, section 2.3.2.1: no more than one ARP request per second to one destination.
inline constexpr std::uint64_t kArpRequestIntervalUs = 1'000'000;

// RFC 1122, section 2.3.2.1: an address unconfirmed for this long is asked for again.
inline constexpr std::uint64_t kArpRefreshUs = 30'000'000;

// An Ethernet address, and when ARP last told it.
struct Told {
  MacAddress mac{};
  std::uint64_t at_us = 0;
};

// Time never goes backwards from call to call.
class PeerResolver {
 public:
  [[nodiscard]] bool known() const { return mac_.has_value(); }

  // Only when known(). An address is never forgotten, only replaced: a peer that is silent for a
  // while loses no message, and one that has gone costs one request a second.
  [[nodiscard]] const MacAddress& mac() const { return *mac_; }

  // The same with the time when it was last told; nothing before.
  [[nodiscard]] std::optional<Told> told() const {
    return mac_ ? std::optional(Told{*mac_, learned_us_}) : std::nullopt;
  }

  void learn(const MacAddress& mac, std::uint64_t now_us);

  // The peer's traffic has come from this station. If that is not the one that is known, one of the
  // two is another's: the station is asked soon whether the peer's address is its own. It is not
  // believed by the traffic alone, because a router passes on what claims to be the peer's, too.
  void hear(const MacAddress& mac);

  // Whom to send an ARP request to now, which then counts as asked: everyone, or the station that
  // was heard (RFC 1122, section 2.3.2.1, "Unicast Poll"). Everyone at the first call, as nothing
  // is known then.
  [[nodiscard]] std::optional<MacAddress> request_due(std::uint64_t now_us);

 private:
  std::optional<MacAddress> heard_;  // to be asked
  std::optional<MacAddress> mac_;
  std::uint64_t learned_us_ = 0;
  std::optional<std::uint64_t> asked_us_;
};

}  // namespace iog::net
