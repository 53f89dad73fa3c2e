// Classifies a received frame. The result is the kind of the frame or the reason why it is dropped.
// The functions accept any bytes and are stateless.
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

// Only the member that corresponds to `kind` is valid. Spans point into the frame.
struct [[nodiscard]] Inbound {
  InboundKind kind = InboundKind::kDropped;
  Drop drop = Drop::kShort;
  Datagram datagram{};
  Ipv4Packet fragment{};  // fragment of a UDP datagram addressed to us
  ArpPacket arp{};
  std::span<const std::byte> echo_request{};  // the whole ICMP message from the peer to us
  std::optional<MacAddress> peer_mac{};  // frame source, if the peer sent a valid datagram or ping
};

// Classifies a reassembled packet as kDatagram or kDropped.
Inbound classify_joined(const Ipv4Packet& packet);

Inbound classify_frame(std::span<const std::byte> frame, const Config& config);

}  // namespace iog::net
