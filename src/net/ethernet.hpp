// Ethernet II framing. A frame consists of a destination, a source, a type and a payload, without
// the preamble and the FCS.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "net/address.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::net {

inline constexpr std::size_t kEthernetHeaderBytes = 14;
inline constexpr std::size_t kMtuBytes = 1500;
inline constexpr std::size_t kMaxFrameBytes = kEthernetHeaderBytes + kMtuBytes;
inline constexpr std::size_t kMinFrameBytes = 60;  // 64 bytes including the FCS (IEEE 802.3)

inline constexpr std::uint16_t kEtherTypeIpv4 = 0x0800;
inline constexpr std::uint16_t kEtherTypeArp = 0x0806;
inline constexpr std::uint16_t kEtherTypeVlan = 0x8100;         // IEEE 802.1Q
inline constexpr std::uint16_t kEtherTypeServiceVlan = 0x88A8;  // IEEE 802.1ad

struct EthernetFrame {
  MacAddress destination;
  MacAddress source;
  std::uint16_t type;
  std::span<const std::byte> payload;  // may include padding at the end
};

// Returns nothing if `frame` is shorter than a header. Frames shorter than kMinFrameBytes are
// accepted because some virtual links do not pad frames.
[[nodiscard]] std::optional<EthernetFrame> parse_ethernet(std::span<const std::byte> frame);

void write_ethernet_header(std::span<std::byte, kEthernetHeaderBytes> target,
                           const MacAddress& destination, const MacAddress& source,
                           std::uint16_t type);

// Returns the all-zero address if the reader reaches the end of its data.
[[nodiscard]] MacAddress read_mac(wire::ByteReader& reader);

void write_mac(wire::ByteWriter& writer, const MacAddress& mac);

}  // namespace iog::net
