// Stores the Ethernet address of one host, here called the peer, and schedules ARP requests for it.
#pragma once

#include <cstdint>
#include <optional>

#include "net/address.hpp"

namespace iog::net {

// RFC 1122, section 2.3.2.1: at most one ARP request per second to one destination.
inline constexpr std::uint64_t kArpRequestIntervalUs = 1'000'000;

// RFC 1122, section 2.3.2.1: an address unconfirmed for this long is requested again.
inline constexpr std::uint64_t kArpRefreshUs = 30'000'000;

// An Ethernet address and the time when ARP last confirmed it.
struct Told {
  MacAddress mac{};
  std::uint64_t at_us = 0;
};

// Times passed to it never decrease.
class PeerResolver {
 public:
  [[nodiscard]] bool known() const { return mac_.has_value(); }

  // Requires known(). An address is replaced but never forgotten: a peer that is silent for a while
  // loses no message, and a peer that is gone costs one request a second.
  [[nodiscard]] const MacAddress& mac() const { return *mac_; }

  // The address and the time of its last confirmation. Nothing if no address is known.
  [[nodiscard]] std::optional<Told> told() const {
    return mac_ ? std::optional(Told{*mac_, learned_us_}) : std::nullopt;
  }

  // An ARP packet gave this address for the peer. Anybody can send an unsolicited ARP packet, so a
  // different station is accepted only if the known one has not answered for an interval. Until
  // then the known station is in doubt, as after hear().
  void learn(const MacAddress& mac, std::uint64_t now_us);

  // Traffic from the peer arrived from this station. If it is not the known station, the known one
  // is soon asked to confirm its address. Traffic alone never replaces the address, because a
  // router also forwards packets with a forged source.
  void hear(const MacAddress& mac);

  // Returns the destination of an ARP request that is due now, and counts the request as sent. A
  // known station in doubt is asked directly (RFC 1122, section 2.3.2.1, "Unicast Poll"). The
  // request is a broadcast while no station is known, when the address is due for a refresh, and
  // when the known station has not answered.
  [[nodiscard]] std::optional<MacAddress> request_due(std::uint64_t now_us);

 private:
  [[nodiscard]] bool is_silent(std::uint64_t now_us) const {
    return unanswered_us_ && now_us - *unanswered_us_ >= kArpRequestIntervalUs;
  }

  std::optional<MacAddress> mac_;
  std::uint64_t learned_us_ = 0;
  std::optional<std::uint64_t> asked_us_;       // the last time
  std::optional<std::uint64_t> unanswered_us_;  // the first time since the address was learnt
  bool is_doubted_ = false;
};

}  // namespace iog::net
