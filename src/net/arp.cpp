#include "net/arp.hpp"

#include "net/ethernet.hpp"
#include "wire/byte_reader.hpp"

namespace iog::net {
namespace {

constexpr std::uint16_t kHardwareEthernet = 1;
constexpr std::uint8_t kHardwareAddressBytes = 6;
constexpr std::uint8_t kProtocolAddressBytes = 4;

// True if the sender can be answered and its address can be learnt.
bool is_other_station(const MacAddress& mac, const Config& config) {
  return mac.is_unicast() && mac != config.mac;
}

}  // namespace

std::optional<ArpPacket> parse_arp(std::span<const std::byte> payload) {
  wire::ByteReader reader{payload};
  const bool ethernet = reader.u16_be() == kHardwareEthernet;
  const bool for_ipv4 = reader.u16_be() == kEtherTypeIpv4;
  const bool sizes = reader.u8() == kHardwareAddressBytes && reader.u8() == kProtocolAddressBytes;
  const auto operation = static_cast<ArpOperation>(reader.u16_be());
  ArpPacket packet{};
  packet.operation = operation;
  packet.sender_mac = read_mac(reader);
  packet.sender_address = Ipv4Address{reader.u32_be()};
  packet.target_mac = read_mac(reader);
  packet.target_address = Ipv4Address{reader.u32_be()};
  const bool known = operation == ArpOperation::kRequest || operation == ArpOperation::kReply;
  if (!reader.ok() || !ethernet || !for_ipv4 || !sizes || !known) {
    return std::nullopt;
  }
  return packet;
}

void write_arp(wire::ByteWriter& writer, const ArpPacket& packet) {
  writer.u16_be(kHardwareEthernet);
  writer.u16_be(kEtherTypeIpv4);
  writer.u8(kHardwareAddressBytes);
  writer.u8(kProtocolAddressBytes);
  writer.u16_be(static_cast<std::uint16_t>(packet.operation));
  write_mac(writer, packet.sender_mac);
  writer.u32_be(packet.sender_address.value);
  write_mac(writer, packet.target_mac);
  writer.u32_be(packet.target_address.value);
}

bool claims_our_address(const ArpPacket& packet, const Config& config) {
  return packet.sender_address == config.address && packet.sender_mac != config.mac;
}

bool asks_for_us(const ArpPacket& packet, const Config& config) {
  const bool answerable =
      packet.sender_address == Ipv4Address{} ||
      is_host_in_subnet(packet.sender_address, config.address, config.prefix_bits);
  return packet.operation == ArpOperation::kRequest && packet.target_address == config.address &&
         is_other_station(packet.sender_mac, config) && answerable;
}

bool tells_mac_of(Ipv4Address host, const ArpPacket& packet, const Config& config) {
  return packet.sender_address == host && is_other_station(packet.sender_mac, config);
}

}  // namespace iog::net
