// Builds the kinds of frame that we send: ARP, echo replies, datagrams. Each function fills the
// front of a buffer that holds the largest frame, pads it with zeros to the smallest, and returns
// the length to commit.
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

// Where in its frame the payload of a message begins.
inline constexpr std::size_t kMessageOffset =
    kEthernetHeaderBytes + kIpv4HeaderBytes + kUdpHeaderBytes;

// Where a datagram goes, and from which of our ports.
struct Destination {
  MacAddress mac{};
  Ipv4Address address{};
  std::uint16_t port = 0;
  std::uint16_t source_port = 0;

  friend constexpr bool operator==(const Destination&, const Destination&) = default;
};

// Asks a station, or everyone, for the Ethernet address of `host`.
[[nodiscard]] std::size_t build_arp_request(FrameBuffer frame, const Config& config,
                                            Ipv4Address host, const MacAddress& whom);

// Tells our Ethernet address to the sender of `request` alone.
[[nodiscard]] std::size_t build_arp_reply(FrameBuffer frame, const Config& config,
                                          const ArpPacket& request);

// Answers the ICMP echo request of the peer, at most kMaxIpv4PayloadBytes long.
[[nodiscard]] std::size_t build_echo_reply(FrameBuffer frame, const Config& config,
                                           const MacAddress& peer_mac, std::uint16_t identification,
                                           std::span<const std::byte> request);

// A datagram with a copy of the payload, which is at most kMaxUdpPayloadBytes long. The frame is
// only written: on the target it lies in uncached memory.
[[nodiscard]] std::size_t build_datagram(FrameBuffer frame, const Config& config,
                                         const Destination& to, std::uint16_t identification,
                                         std::span<const std::byte> payload);

}  // namespace iog::net
