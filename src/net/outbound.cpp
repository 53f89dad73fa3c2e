#include "net/outbound.hpp"

#include "net/icmp.hpp"
#include "wire/byte_writer.hpp"

namespace iog::net {
namespace {

constexpr std::size_t kIpv4Offset = kEthernetHeaderBytes;
constexpr std::size_t kIpv4PayloadOffset = kIpv4Offset + kIpv4HeaderBytes;

// Transmit buffers are reused. Zeros keep old messages out of the padding.
std::size_t padded(FrameBuffer frame, std::size_t frame_bytes) {
  if (frame_bytes >= kMinFrameBytes) {
    return frame_bytes;
  }
  wire::ByteWriter{frame.subspan(frame_bytes)}.zeros(kMinFrameBytes - frame_bytes);
  return kMinFrameBytes;
}

std::size_t build_arp(FrameBuffer frame, const MacAddress& destination, const ArpPacket& packet) {
  write_ethernet_header(frame.first<kEthernetHeaderBytes>(), destination, packet.sender_mac,
                        kEtherTypeArp);
  wire::ByteWriter writer{frame.subspan<kEthernetHeaderBytes>()};
  write_arp(writer, packet);
  return padded(frame, kEthernetHeaderBytes + writer.written().size());
}

// The IPv4 payload must already be in place.
std::size_t wrap_ipv4(FrameBuffer frame, const MacAddress& to, const MacAddress& from,
                      const Ipv4Header& header) {
  write_ethernet_header(frame.first<kEthernetHeaderBytes>(), to, from, kEtherTypeIpv4);
  write_ipv4_header(frame.subspan<kIpv4Offset, kIpv4HeaderBytes>(), header);
  return padded(frame, kIpv4PayloadOffset + header.payload_bytes);
}

}  // namespace

std::size_t build_arp_request(FrameBuffer frame, const Config& config, Ipv4Address host,
                              const MacAddress& whom) {
  return build_arp(frame, whom,
                   {.operation = ArpOperation::kRequest,
                    .sender_mac = config.mac,
                    .sender_address = config.address,
                    .target_mac = {},
                    .target_address = host});
}

std::size_t build_arp_reply(FrameBuffer frame, const Config& config, const ArpPacket& request) {
  return build_arp(frame, request.sender_mac,
                   {.operation = ArpOperation::kReply,
                    .sender_mac = config.mac,
                    .sender_address = config.address,
                    .target_mac = request.sender_mac,
                    .target_address = request.sender_address});
}

std::size_t build_echo_reply(FrameBuffer frame, const Config& config, const MacAddress& peer_mac,
                             std::uint16_t identification, std::span<const std::byte> request) {
  write_echo_reply(frame.subspan(kIpv4PayloadOffset, request.size()), request);
  return wrap_ipv4(frame, peer_mac, config.mac,
                   {.source = config.address,
                    .destination = config.peer,
                    .protocol = kProtocolIcmp,
                    .identification = identification,
                    .payload_bytes = request.size()});
}

std::size_t build_datagram(FrameBuffer frame, const Config& config, const Destination& to,
                           std::uint16_t identification, std::span<const std::byte> payload) {
  const std::size_t datagram_bytes = write_udp(frame.subspan(kIpv4PayloadOffset),
                                               {.source = config.address,
                                                .destination = to.address,
                                                .source_port = to.source_port,
                                                .destination_port = to.port},
                                               payload);
  return wrap_ipv4(frame, to.mac, config.mac,
                   {.source = config.address,
                    .destination = to.address,
                    .protocol = kProtocolUdp,
                    .identification = identification,
                    .payload_bytes = datagram_bytes});
}

}  // namespace iog::net
