#include "net/udp.hpp"

#include "net/checksum.hpp"
#include "wire/byte_order.hpp"
#include "wire/byte_reader.hpp"
#include "wire/byte_writer.hpp"

namespace iog::net {
namespace {

constexpr std::size_t kChecksumOffset = 6;

// Over the pseudo header (source, destination, protocol, length) and the datagram as it stands.
std::uint16_t udp_checksum(Ipv4Address source, Ipv4Address destination,
                           std::span<const std::byte> datagram) {
  Checksum checksum;
  checksum.add_u32(source.value);
  checksum.add_u32(destination.value);
  checksum.add_u16(kProtocolUdp);
  checksum.add_u16(static_cast<std::uint16_t>(datagram.size()));
  checksum.add(datagram);
  return checksum.value();
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
  if (has_checksum && udp_checksum(packet.source, packet.destination, datagram) != 0) {
    return {.status = UdpStatus::kBadChecksum};
  }
  return {.status = UdpStatus::kOk,
          .datagram = {.source = packet.source,
                       .source_port = source_port,
                       .destination_port = destination_port,
                       .payload = datagram.subspan(kUdpHeaderBytes)}};
}

void write_udp_header(std::span<std::byte> datagram, const UdpHeader& header) {
  wire::ByteWriter writer{datagram};
  writer.u16_be(header.source_port);
  writer.u16_be(header.destination_port);
  writer.u16_be(static_cast<std::uint16_t>(datagram.size()));
  writer.u16_be(0);
  if (!writer.ok()) {
    return;
  }
  // A computed 0 is sent as its other representation, because 0 says "no checksum".
  const std::uint16_t checksum = udp_checksum(header.source, header.destination, datagram);
  wire::store_be16(datagram.subspan<kChecksumOffset, 2>(), checksum == 0 ? 0xFFFF : checksum);
}

}  // namespace iog::net
