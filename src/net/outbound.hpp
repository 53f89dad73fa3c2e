// Builds outgoing ARP packets, echo replies and datagrams. Each function writes a frame to the
// front of a buffer, pads it with zeros to the minimum length, and returns the length to commit.
// The buffer can hold the largest frame.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "net/address.hpp"
#include "net/arp.hpp"
#include "net/config.hpp"
#include "net/ethernet.hpp"
#include "net/ipv4.hpp"
#include "net/udp.hpp"

namespace iog::net {

using FrameBuffer = std::span<std::byte, kMaxFrameBytes>;

// The offset of the message payload in the frame.
inline constexpr std::size_t kMessageOffset =
    kEthernetHeaderBytes + kIpv4HeaderBytes + kUdpHeaderBytes;

// The destination of a datagram, and our source port.
struct Destination {
  MacAddress mac{};
  Ipv4Address address{};
  std::uint16_t port = 0;
  std::uint16_t source_port = 0;

  friend constexpr bool operator==(const Destination&, const Destination&) = default;
};

// Builds an ARP request for the Ethernet address of `host`. `whom` is the Ethernet address of one
// station or the broadcast address.
[[nodiscard]] std::size_t build_arp_request(FrameBuffer frame, const Config& config,
                                            Ipv4Address host, const MacAddress& whom);

// Builds a unicast reply that tells the sender of `request` our Ethernet address.
[[nodiscard]] std::size_t build_arp_reply(FrameBuffer frame, const Config& config,
                                          const ArpPacket& request);

// Builds the answer to an ICMP echo request from the peer. The request must be at most
// kMaxIpv4PayloadBytes long.
[[nodiscard]] std::size_t build_echo_reply(FrameBuffer frame, const Config& config,
                                           const MacAddress& peer_mac, std::uint16_t identification,
                                           std::span<const std::byte> request);

// Builds a datagram with a copy of the payload. The payload must be at most kMaxUdpPayloadBytes
// long. On the target, the frame is in uncached memory, so the function writes it but never reads
// it.
[[nodiscard]] std::size_t build_datagram(FrameBuffer frame, const Config& config,
                                         const Destination& to, std::uint16_t identification,
                                         std::span<const std::byte> payload);

}  // namespace iog::net
