#include "net/ethernet.hpp"

namespace iog::net {

std::optional<EthernetFrame> parse_ethernet(std::span<const std::byte> frame) {
  wire::ByteReader reader{frame};
  EthernetFrame parsed{};
  parsed.destination = read_mac(reader);
  parsed.source = read_mac(reader);
  parsed.type = reader.u16_be();
  parsed.payload = reader.bytes(reader.remaining());
  if (!reader.ok()) {
    return std::nullopt;
  }
  return parsed;
}

void write_ethernet_header(std::span<std::byte, kEthernetHeaderBytes> target,
                           const MacAddress& destination, const MacAddress& source,
                           std::uint16_t type) {
  wire::ByteWriter writer{target};
  write_mac(writer, destination);
  write_mac(writer, source);
  writer.u16_be(type);
}

MacAddress read_mac(wire::ByteReader& reader) {
  MacAddress mac{};
  for (std::uint8_t& octet : mac.octets) {
    octet = reader.u8();
  }
  // If the reader ran out, the address is incomplete and must not be used.
  return reader.ok() ? mac : MacAddress{};
}

void write_mac(wire::ByteWriter& writer, const MacAddress& mac) {
  for (const std::uint8_t octet : mac.octets) {
    writer.u8(octet);
  }
}

}  // namespace iog::net
