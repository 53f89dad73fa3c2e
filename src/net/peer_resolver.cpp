#include "net/peer_resolver.hpp"

namespace iog::net {

void PeerResolver::learn(const MacAddress& mac, std::uint64_t now_us) {
  mac_ = mac;
  learned_us_ = now_us;
  heard_.reset();
}

void PeerResolver::hear(const MacAddress& mac) {
  if (known() && mac != *mac_ && mac.is_unicast()) {
    heard_ = mac;
  }
}

std::optional<MacAddress> PeerResolver::request_due(std::uint64_t now_us) {
  const bool everyone = !known() || now_us - learned_us_ >= kArpRefreshUs;
  const bool allowed = !asked_us_ || now_us - *asked_us_ >= kArpRequestIntervalUs;
  if (!allowed || !(everyone || heard_)) {
    return std::nullopt;
  }
  asked_us_ = now_us;
  const MacAddress whom = everyone ? kBroadcastMac : *heard_;
  heard_.reset();
  return whom;
}

}  // namespace iog::net
