// Classifies a received frame: its kind, or why it is dropped. Accepts any bytes and keeps no
// state.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "net/arp.hpp"
#include "net/config.hpp"
#include "net/counters.hpp"
#include "net/udp.hpp"

namespace iog::net {

enum class InboundKind : std::uint8_t { kDropped, kDatagram, kFragment, kArp, kEchoRequest };

// Only the member that `kind` names is meaningful. Spans point into the frame.
struct [[nodiscard]] Inbound {
  InboundKind kind = InboundKind::kDropped;
  Drop drop = Drop::kShort;
  Datagram datagram{};
  Ipv4Packet fragment{};  // part of a UDP datagram addressed to us
  ArpPacket arp{};
  std::span<const std::byte> echo_request{};  // the whole ICMP message, from the peer to us
  std::optional<MacAddress> peer_mac{};  // frame source of a valid datagram or ping from the peer
};

// Classifies a reassembled packet: kDatagram or kDropped.
Inbound classify_joined(const Ipv4Packet& packet);

Inbound classify_frame(std::span<const std::byte> frame, const Config& config);

}  // namespace iog::net
