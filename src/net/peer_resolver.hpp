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

  // ARP has given the peer's address. Anybody can send an unrequested ARP packet, so another
  // station is believed only if the known one has not answered for an interval. Until then the
  // known one is in doubt, as with hear().
  void learn(const MacAddress& mac, std::uint64_t now_us);

  // The peer's traffic has come from this station. If it is not the known one, the known one is
  // asked soon whether the address is still its own. Traffic alone proves no station, because a
  // router also forwards packets that only claim to be the peer's.
  void hear(const MacAddress& mac);

  // The destination of an ARP request that is due now, which then counts as sent: the known station
  // alone if it is in doubt (RFC 1122, section 2.3.2.1, "Unicast Poll"), else everyone. Everyone
  // also at the first call, when nothing is known, and if the known station has not answered.
  [[nodiscard]] std::optional<MacAddress> request_due(std::uint64_t now_us);

 private:
  [[nodiscard]] bool is_silent(std::uint64_t now_us) const {
    return unanswered_us_ && now_us - *unanswered_us_ >= kArpRequestIntervalUs;
  }

  std::optional<MacAddress> mac_;
  std::uint64_t learned_us_ = 0;
  std::optional<std::uint64_t> asked_us_;       // the last time
  std::optional<std::uint64_t> unanswered_us_;  // the first time since it was learnt
  bool is_doubted_ = false;
};

}  // namespace iog::net
