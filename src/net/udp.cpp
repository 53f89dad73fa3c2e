#include "net/udp.hpp"

#include "net/checksum.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::net {
namespace {

// Sums the pseudo header: source, destination, protocol and length (RFC 768).
Checksum pseudo_checksum(Ipv4Address source, Ipv4Address destination, std::size_t datagram_bytes) {
  Checksum checksum;
  checksum.add_u32(source.value);
  checksum.add_u32(destination.value);
  checksum.add_u16(kProtocolUdp);
  checksum.add_u16(static_cast<std::uint16_t>(datagram_bytes));
  return checksum;
}

bool is_sound(const Ipv4Packet& packet, std::span<const std::byte> datagram) {
  Checksum checksum = pseudo_checksum(packet.source, packet.destination, datagram.size());
  checksum.add(datagram);
  return checksum.value() == 0;
}

}  // namespace

UdpResult parse_udp(const Ipv4Packet& packet) {
  wire::ByteReader reader{packet.payload};
  const std::uint16_t source_port = reader.u16_be();
  const std::uint16_t destination_port = reader.u16_be();
  const std::size_t length = reader.u16_be();
  const bool has_checksum = reader.u16_be() != 0;
  if (!reader.ok() || length < kUdpHeaderBytes || length > packet.payload.size()) {
    return {.status = UdpStatus::kBadLength};
  }
  const auto datagram = packet.payload.first(length);
  if (has_checksum && !is_sound(packet, datagram)) {
    return {.status = UdpStatus::kBadChecksum};
  }
  return {.status = UdpStatus::kOk,
          .datagram = {.source = packet.source,
                       .destination = packet.destination,
                       .source_port = source_port,
                       .destination_port = destination_port,
                       .payload = datagram.subspan(kUdpHeaderBytes),
                       .station = {}}};
}

std::size_t write_udp(std::span<std::byte> target, const UdpHeader& header,
                      std::span<const std::byte> payload) {
  const std::size_t datagram_bytes = kUdpHeaderBytes + payload.size();
  Checksum sum = pseudo_checksum(header.source, header.destination, datagram_bytes);
  sum.add_u16(header.source_port);
  sum.add_u16(header.destination_port);
  sum.add_u16(static_cast<std::uint16_t>(datagram_bytes));
  sum.add_copied(payload, target.subspan(kUdpHeaderBytes));

  wire::ByteWriter writer{target.first<kUdpHeaderBytes>()};
  writer.u16_be(header.source_port);
  writer.u16_be(header.destination_port);
  writer.u16_be(static_cast<std::uint16_t>(datagram_bytes));
  // A computed 0 is sent as 0xFFFF, its other representation, because 0 means "no checksum".
  const std::uint16_t checksum = sum.value();
  writer.u16_be(checksum == 0 ? 0xFFFF : checksum);
  return datagram_bytes;
}

}  // namespace iog::net
