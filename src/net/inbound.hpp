// Classifies a received frame: what it is to us, or why it is dropped. It accepts any bytes and
// keeps no state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "net/arp.hpp"
#include "net/config.hpp"
#include "net/counters.hpp"
#include "net/udp.hpp"

namespace iog::net {

enum class InboundKind : std::uint8_t { kDropped, kDatagram, kArp, kEchoRequest };

// Only the member that `kind` names is meaningful. Views point into the frame.
struct [[nodiscard]] Inbound {
  InboundKind kind = InboundKind::kDropped;
  Drop drop = Drop::kShort;
  Datagram datagram{};
  ArpPacket arp{};
  std::span<const std::byte> echo_request{};  // the whole ICMP message, sent by the peer to us
};

Inbound classify_frame(std::span<const std::byte> frame, const Config& config);

}  // namespace iog::net
