// Builds the four kinds of frame that we send. Each function fills the front of a buffer that holds
// the largest frame, pads it with zeros to the smallest, and returns the length to commit.
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

inline constexpr std::size_t kMessageOffset =
    kEthernetHeaderBytes + kIpv4HeaderBytes + kUdpHeaderBytes;

// Where in the frame a message's payload is written before build_message() wraps it.
[[nodiscard]] constexpr std::span<std::byte, kMaxUdpPayloadBytes> message_payload(
    FrameBuffer frame) {
  return frame.subspan<kMessageOffset, kMaxUdpPayloadBytes>();
}

// Asks everyone for the peer's Ethernet address.
[[nodiscard]] std::size_t build_arp_request(FrameBuffer frame, const Config& config);

// Tells the sender of `request`, and nobody else, our Ethernet address.
[[nodiscard]] std::size_t build_arp_reply(FrameBuffer frame, const Config& config,
                                          const ArpPacket& request);

// Answers the ICMP echo request of the peer, at most kMaxIpv4PayloadBytes long.
[[nodiscard]] std::size_t build_echo_reply(FrameBuffer frame, const Config& config,
                                           const MacAddress& peer_mac, std::uint16_t identification,
                                           std::span<const std::byte> request);

// Wraps the first `payload_bytes`, at most kMaxUdpPayloadBytes, of message_payload(frame).
[[nodiscard]] std::size_t build_message(FrameBuffer frame, const Config& config,
                                        const MacAddress& peer_mac, std::uint16_t identification,
                                        std::size_t payload_bytes);

}  // namespace iog::net
