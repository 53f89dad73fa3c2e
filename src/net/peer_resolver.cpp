#include "net/peer_resolver.hpp"

namespace iog::net {

void PeerResolver::learn(const MacAddress& mac, std::uint64_t now_us) {
  if (known() && mac != *mac_ && !is_silent(now_us)) {
    is_doubted_ = true;
    return;
  }
  mac_ = mac;
  learned_us_ = now_us;
  unanswered_us_.reset();
  is_doubted_ = false;
}

void PeerResolver::hear(const MacAddress& mac) {
  is_doubted_ = is_doubted_ || (known() && mac != *mac_ && mac.is_unicast());
}

std::optional<MacAddress> PeerResolver::request_due(std::uint64_t now_us) {
  const bool everyone = !known() || now_us - learned_us_ >= kArpRefreshUs || is_silent(now_us);
  const bool allowed = !asked_us_ || now_us - *asked_us_ >= kArpRequestIntervalUs;
  if (!allowed || !(everyone || is_doubted_)) {
    return std::nullopt;
  }
  asked_us_ = now_us;
  unanswered_us_ = unanswered_us_.value_or(now_us);
  return everyone ? kBroadcastMac : *mac_;
}

}  // namespace iog::net
