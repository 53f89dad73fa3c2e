#include "net/inbound.hpp"

#include "net/ethernet.hpp"
#include "net/icmp.hpp"
#include "net/ipv4.hpp"

namespace iog::net {
namespace {

Inbound dropped(Drop cause) { return {.kind = InboundKind::kDropped, .drop = cause}; }

bool is_vlan(std::uint16_t type) { return type == kEtherTypeVlan || type == kEtherTypeServiceVlan; }

bool has_joined(const Config& config) { return config.service_instance != 0; }

// Lidars commonly broadcast, to the limited or the subnet's broadcast address.
bool reaches_us(Ipv4Address destination, const Config& config) {
  return destination == config.address || destination == kLimitedBroadcast ||
         destination == directed_broadcast(config.address, config.prefix_bits) ||
         (has_joined(config) && destination == kDiscoveryGroup);
}

bool reaches_us(const MacAddress& destination, const Config& config) {
  return destination == config.mac || destination == kBroadcastMac ||
         (has_joined(config) && destination == kDiscoveryGroupMac);
}

bool can_be_source(Ipv4Address source, const Config& config) {
  return is_host_address(source) && source != config.address &&
         source != directed_broadcast(config.address, config.prefix_bits);
}

Inbound classify_udp(const Ipv4Packet& packet) {
  const UdpResult result = parse_udp(packet);
  switch (result.status) {
    case UdpStatus::kOk:
      return {.kind = InboundKind::kDatagram, .datagram = result.datagram};
    case UdpStatus::kBadChecksum:
      return dropped(Drop::kBadUdpChecksum);
    case UdpStatus::kBadLength:
      break;
  }
  return dropped(Drop::kBadUdpLength);
}

// Pings from other hosts or to a broadcast address (RFC 1122, section 3.2.2.6) are not answered.
// Neither is a request whose reply would not fit one frame.
Inbound classify_ping(const Ipv4Packet& packet, const Config& config) {
  switch (classify_icmp(packet.payload)) {
    case IcmpStatus::kEchoRequest:
      if (packet.source != config.peer || packet.destination != config.address ||
          packet.payload.size() > kMaxIpv4PayloadBytes) {
        return dropped(Drop::kPingIgnored);
      }
      return {.kind = InboundKind::kEchoRequest, .echo_request = packet.payload};
    case IcmpStatus::kOther:
      return dropped(Drop::kIcmpIgnored);
    case IcmpStatus::kBad:
      break;
  }
  return dropped(Drop::kBadIcmp);
}

Inbound classify_packet(const Ipv4Packet& packet, bool is_fragment, const Config& config) {
  if (!reaches_us(packet.destination, config)) {
    return dropped(Drop::kNotForUsIp);
  }
  if (!can_be_source(packet.source, config)) {
    return dropped(Drop::kBadSource);
  }
  if (is_fragment) {
    return packet.protocol == kProtocolUdp
               ? Inbound{.kind = InboundKind::kFragment, .fragment = packet}
               : dropped(Drop::kFragment);
  }
  switch (packet.protocol) {
    case kProtocolUdp:
      return classify_udp(packet);
    case kProtocolIcmp:
      return classify_ping(packet, config);
    default:
      return dropped(Drop::kNotUdpOrIcmp);
  }
}

Inbound classify_ipv4(std::span<const std::byte> payload, const Config& config) {
  const Ipv4Result result = parse_ipv4(payload);
  switch (result.status) {
    case Ipv4Status::kOk:
    case Ipv4Status::kFragment:
      return classify_packet(result.packet, result.status == Ipv4Status::kFragment, config);
    case Ipv4Status::kBadChecksum:
      return dropped(Drop::kBadIpChecksum);
    case Ipv4Status::kBadHeader:
      break;
  }
  return dropped(Drop::kBadIpHeader);
}

// Only a packet that is valid in every layer counts as traffic from the peer.
bool is_of_peer(const Inbound& inbound, const Config& config) {
  return inbound.kind == InboundKind::kEchoRequest ||
         (inbound.kind == InboundKind::kDatagram && inbound.datagram.source == config.peer);
}

Inbound classify_ipv4(const EthernetFrame& frame, const Config& config) {
  Inbound inbound = classify_ipv4(frame.payload, config);
  if (is_of_peer(inbound, config)) {
    inbound.peer_mac = frame.source;
  }
  inbound.datagram.station = frame.source;
  return inbound;
}

Inbound classify_arp(std::span<const std::byte> payload) {
  const std::optional<ArpPacket> packet = parse_arp(payload);
  if (!packet) {
    return dropped(Drop::kBadArp);
  }
  return {.kind = InboundKind::kArp, .arp = *packet};
}

}  // namespace

Inbound classify_joined(const Ipv4Packet& packet) { return classify_udp(packet); }

Inbound classify_frame(std::span<const std::byte> frame, const Config& config) {
  const std::optional<EthernetFrame> ethernet = parse_ethernet(frame);
  if (!ethernet) {
    return dropped(Drop::kShort);
  }
  if (!reaches_us(ethernet->destination, config)) {
    return dropped(Drop::kNotForUsMac);
  }
  if (is_vlan(ethernet->type)) {
    return dropped(Drop::kVlanTagged);
  }
  switch (ethernet->type) {
    case kEtherTypeIpv4:
      return classify_ipv4(*ethernet, config);
    case kEtherTypeArp:
      return classify_arp(ethernet->payload);
    default:
      return dropped(Drop::kNotIpv4OrArp);
  }
}

}  // namespace iog::net
