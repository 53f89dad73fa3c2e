// Stores the Ethernet address of one host, called the peer here, and schedules ARP requests for
// this address.
#pragma once

#include <cstdint>
#include <optional>

#include "net/address.hpp"

namespace iog::net {

// ARP requests for the same host are sent at most once per second (RFC 1122, section 2.3.2.1).
inline constexpr std::uint64_t kArpRequestIntervalUs = 1'000'000;

// If an address has not been confirmed for kArpRefreshUs, it is requested again (RFC 1122, section
// 2.3.2.1).
inline constexpr std::uint64_t kArpRefreshUs = 30'000'000;

// An Ethernet address and the time at which ARP last confirmed it.
struct Told {
  MacAddress mac{};
  std::uint64_t at_us = 0;
};

// The times passed to a PeerResolver must not decrease.
class PeerResolver {
 public:
  [[nodiscard]] bool known() const { return mac_.has_value(); }

  // Requires known(). An address can be replaced, but it is never deleted. Messages are therefore
  // not lost if the peer is silent for a while. If the peer is gone, one request per second is
  // sent.
  [[nodiscard]] const MacAddress& mac() const { return *mac_; }

  // Returns the address and the time at which ARP last confirmed it, or nothing if no address is
  // known.
  [[nodiscard]] std::optional<Told> told() const {
    return mac_ ? std::optional(Told{*mac_, learned_us_}) : std::nullopt;
  }

  // Call learn() when an ARP packet states that `mac` is the peer's Ethernet address. Anyone can
  // send an unsolicited ARP packet. Another station's address is therefore accepted only if the
  // known station has left a request unanswered for kArpRequestIntervalUs. Until then, the packet
  // only marks the known station as unconfirmed.
  void learn(const MacAddress& mac, std::uint64_t now_us);

  // Call hear() when a frame with the peer's IP address arrives. `mac` is the source MAC address of
  // the frame. If `mac` differs from the known address, the known station is marked as unconfirmed.
  // Traffic alone never replaces the address, because a router may also forward packets with a
  // forged source.
  void hear(const MacAddress& mac);

  // If an ARP request is due now, returns its destination and assumes that the caller sends the
  // request. If the known station is unconfirmed, the request is sent directly to it (RFC 1122,
  // section 2.3.2.1, "Unicast Poll"). The request is broadcast if no station is known, if the
  // address is due for a refresh, or if the known station has not answered.
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
