// ARP for IPv4 on Ethernet (RFC 826): its packet, and what a packet means to us.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "net/address.hpp"
#include "net/config.hpp"
#include "wire/byte_writer.hpp"

namespace iog::net {

inline constexpr std::size_t kArpPacketBytes = 28;

enum class ArpOperation : std::uint16_t { kRequest = 1, kReply = 2 };

struct ArpPacket {
  ArpOperation operation = ArpOperation::kRequest;
  MacAddress sender_mac{};
  Ipv4Address sender_address{};
  MacAddress target_mac{};
  Ipv4Address target_address{};
};

// Nothing if the payload is short, not about Ethernet and IPv4, or neither request nor reply.
[[nodiscard]] std::optional<ArpPacket> parse_arp(std::span<const std::byte> payload);

void write_arp(wire::ByteWriter& writer, const ArpPacket& packet);

// True if a station that is not us uses our address (RFC 5227, section 2.4).
[[nodiscard]] bool claims_our_address(const ArpPacket& packet, const Config& config);

// True if the packet asks for our address and may be answered: the asker is a station, and a host
// of our subnet or one that probes for a free address (sender 0.0.0.0, RFC 5227, section 2.1.1).
[[nodiscard]] bool asks_for_us(const ArpPacket& packet, const Config& config);

// True if the packet, request or reply, tells the Ethernet address of `host`.
[[nodiscard]] bool tells_mac_of(Ipv4Address host, const ArpPacket& packet, const Config& config);

}  // namespace iog::net
