// Parses, writes and interprets ARP packets for IPv4 over Ethernet (RFC 826).
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

// Returns nothing if the payload is too short, if it is not for Ethernet and IPv4, or if it is
// neither a request nor a reply.
[[nodiscard]] std::optional<ArpPacket> parse_arp(std::span<const std::byte> payload);

void write_arp(wire::ByteWriter& writer, const ArpPacket& packet);

// Returns true if another station uses our address (RFC 5227, section 2.4).
[[nodiscard]] bool claims_our_address(const ArpPacket& packet, const Config& config);

// Returns true if the packet is a request for our address that we may answer. The sender must be
// another station with a unicast address. The sender's IPv4 address must be a host address in our
// subnet, or 0.0.0.0 for an address probe (RFC 5227, section 2.1.1).
[[nodiscard]] bool asks_for_us(const ArpPacket& packet, const Config& config);

// Returns true if the packet contains the Ethernet address of `host`. The packet may be a request
// or a reply.
[[nodiscard]] bool tells_mac_of(Ipv4Address host, const ArpPacket& packet, const Config& config);

}  // namespace iog::net
