// The IPv4 header (RFC 791). The headers of sent packets have no options.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "net/address.hpp"
#include "net/ethernet.hpp"

namespace iog::net {

inline constexpr std::size_t kIpv4HeaderBytes = 20;
inline constexpr std::size_t kMaxIpv4PayloadBytes = kMtuBytes - kIpv4HeaderBytes;

inline constexpr std::uint8_t kProtocolIcmp = 1;
inline constexpr std::uint8_t kProtocolUdp = 17;

enum class Ipv4Status : std::uint8_t { kOk, kBadHeader, kBadChecksum, kFragment };

struct Ipv4Packet {
  Ipv4Address source{};
  Ipv4Address destination{};
  std::uint8_t protocol = 0;
  std::uint16_t identification = 0;
  // The byte offset of the payload in its datagram. The offset is a multiple of 8 and is below
  // 2^16. `has_more_fragments` is false only for the last fragment.
  std::uint32_t fragment_offset = 0;
  bool has_more_fragments = false;
  std::span<const std::byte> payload{};  // length from the header; without options and padding
};

struct [[nodiscard]] Ipv4Result {
  Ipv4Status status = Ipv4Status::kBadHeader;
  Ipv4Packet packet{};  // valid only for kOk and kFragment
};

// Returns kBadHeader if the packet is shorter than a header, if the version is not 4, or if the
// header length or total length is invalid. Returns kBadChecksum if the header checksum is wrong.
// Returns kFragment if the packet is valid but contains only part of a datagram.
Ipv4Result parse_ipv4(std::span<const std::byte> bytes);

// The header fields that differ between sent packets.
struct Ipv4Header {
  Ipv4Address source{};
  Ipv4Address destination{};
  std::uint8_t protocol = 0;
  std::uint16_t identification = 0;
  std::size_t payload_bytes = 0;      // at most kMaxIpv4PayloadBytes
  std::uint16_t fragment_offset = 0;  // in bytes; a multiple of 8
  bool has_more_fragments = false;
};

// Sets the Don't Fragment flag unless the packet is a fragment. Sets the time to live to 64 (RFC
// 1700) and computes the checksum.
void write_ipv4_header(std::span<std::byte, kIpv4HeaderBytes> target, const Ipv4Header& header);

}  // namespace iog::net
