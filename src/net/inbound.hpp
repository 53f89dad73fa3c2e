// Classifies a received frame: what it is to us, or why it is dropped. It accepts any bytes and
// keeps no state.
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

// Only the member that `kind` names is meaningful. Views point into the frame.
struct [[nodiscard]] Inbound {
  InboundKind kind = InboundKind::kDropped;
  Drop drop = Drop::kShort;
  Datagram datagram{};
  Ipv4Packet fragment{};  // of a UDP datagram to us
  ArpPacket arp{};
  std::span<const std::byte> echo_request{};  // the whole ICMP message, sent by the peer to us
  std::optional<MacAddress> peer_mac{};  // of a datagram or ping of the peer: its frame's source
};

// The whole packet that fragments have become: kDatagram or kDropped.
Inbound classify_joined(const Ipv4Packet& packet);

Inbound classify_frame(std::span<const std::byte> frame, const Config& config);

}  // namespace iog::net
