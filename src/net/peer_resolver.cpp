#include "net/peer_resolver.hpp"

namespace iog::net {

void PeerResolver::learn(const MacAddress& mac, std::uint64_t now_us) {
  mac_ = mac;
  learned_us_ = now_us;
}

bool PeerResolver::request_due(std::uint64_t now_us) {
  const bool wanted = !known() || now_us - learned_us_ >= kArpRefreshUs;
  const bool allowed = !asked_us_ || now_us - *asked_us_ >= kArpRequestIntervalUs;
  if (!wanted || !allowed) {
    return false;
  }
  asked_us_ = now_us;
  return true;
}

}  // namespace iog::net
