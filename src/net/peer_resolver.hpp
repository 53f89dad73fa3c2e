// Stores the Ethernet address of one host and schedules ARP requests for it. In this file, the host
// is called the peer.
#pragma once

#include <cstdint>
#include <optional>

#include "net/address.hpp"

namespace iog::net {

// RFC 1122, section 2.3.2.1: at most one ARP request per second is sent to the same destination.
inline constexpr std::uint64_t kArpRequestIntervalUs = 1'000'000;

// RFC 1122, section 2.3.2.1: an address is requested again if it has not been confirmed for this
// long.
inline constexpr std::uint64_t kArpRefreshUs = 30'000'000;

// An Ethernet address and the time of its last confirmation by ARP.
struct Told {
  MacAddress mac{};
  std::uint64_t at_us = 0;
};

// The times passed to it must not decrease.
class PeerResolver {
 public:
  [[nodiscard]] bool known() const { return mac_.has_value(); }

  // Requires known(). An address can be replaced but is never deleted. A peer that is quiet for a
  // while therefore loses no message, and a peer that has gone costs one request per second.
  [[nodiscard]] const MacAddress& mac() const { return *mac_; }

  // The address and the time of its last confirmation. Returns nothing if no address is known.
  [[nodiscard]] std::optional<Told> told() const {
    return mac_ ? std::optional(Told{*mac_, learned_us_}) : std::nullopt;
  }

  // Call it when an ARP packet contains this address for the peer. Anyone can send an unsolicited
  // ARP packet. A different station is therefore accepted only if the known station has not
  // answered for one interval. Until then the known station is in doubt, as it is after hear().
  void learn(const MacAddress& mac, std::uint64_t now_us);

  // Call it when a frame with the peer's IP address arrives. `mac` is the source MAC address of the
  // frame. If `mac` is not the known MAC address, the known station is soon asked to confirm its
  // address. Traffic alone never replaces the address, because a router also forwards packets with
  // a forged source.
  void hear(const MacAddress& mac);

  // Returns the destination if an ARP request is due now, and counts the request as sent. A known
  // station in doubt receives the request directly (RFC 1122, section 2.3.2.1, "Unicast Poll"). The
  // request is a broadcast if no station is known, if the address is due for a refresh, or if the
  // known station has not answered.
  [[nodiscard]] std::optional<MacAddress> request_due(std::uint64_t now_us);

 private:
  [[nodiscard]] bool is_silent(std::uint64_t now_us) const {
    return unanswered_us_ && now_us - *unanswered_us_ >= kArpRequestIntervalUs;
  }

  std::optional<MacAddress> mac_;
  std::uint64_t learned_us_ = 0;
  std::optional<std::uint64_t> asked_us_;       // time of the last request
  std::optional<std::uint64_t> unanswered_us_;  // time of the first request without an answer
  bool is_doubted_ = false;
};

}  // namespace iog::net
