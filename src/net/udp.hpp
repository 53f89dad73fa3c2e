// The UDP header (RFC 768) and its checksum.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "net/ipv4.hpp"

namespace iog::net {

inline constexpr std::size_t kUdpHeaderBytes = 8;
inline constexpr std::size_t kMaxUdpPayloadBytes = kMaxIpv4PayloadBytes - kUdpHeaderBytes;

// A UDP datagram addressed to us. The payload is a view of the received frame or, if the datagram
// was fragmented, of the reassembled bytes.
struct Datagram {
  Ipv4Address source{};
  Ipv4Address destination{};  // our address, a broadcast address that includes us, or our group
  std::uint16_t source_port = 0;
  std::uint16_t destination_port = 0;
  std::span<const std::byte> payload{};
  MacAddress station{};  // source of the frame; all zero for a reassembled datagram
};

enum class UdpStatus : std::uint8_t { kOk, kBadLength, kBadChecksum };

struct [[nodiscard]] UdpResult {
  UdpStatus status = UdpStatus::kBadLength;
  Datagram datagram{};  // valid only for kOk
};

// Returns kBadLength if the UDP length is less than kUdpHeaderBytes or exceeds the length of the
// packet's payload. Returns kBadChecksum if a checksum is present (not 0) but wrong. Bytes beyond
// the UDP length are ignored.
UdpResult parse_udp(const Ipv4Packet& packet);

struct UdpHeader {
  Ipv4Address source{};
  Ipv4Address destination{};
  std::uint16_t source_port = 0;
  std::uint16_t destination_port = 0;
};

// Writes the header and a copy of the payload to the front of `target`. The payload must be at most
// kMaxUdpPayloadBytes long. `target` must be large enough for the header and the payload. The
// function never reads from `target`. The checksum is always computed and is never 0. Returns the
// number of bytes written.
std::size_t write_udp(std::span<std::byte> target, const UdpHeader& header,
                      std::span<const std::byte> payload);

}  // namespace iog::net
