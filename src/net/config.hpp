// The target's own addresses and its peer's. One aggregate, of the car in the image.
#pragma once

#include <cstdint>

#include "net/address.hpp"

namespace iog::net {

// Where services are discovered (AUTOSAR PRS_SOMEIPServiceDiscoveryProtocol names the parameters
// SD_MULTICAST_IP and SD_PORT; these are the values that everybody uses).
inline constexpr Ipv4Address kDiscoveryGroup = ipv4(224, 244, 224, 245);
inline constexpr MacAddress kDiscoveryGroupMac = group_mac(kDiscoveryGroup);
inline constexpr std::uint16_t kDiscoveryPort = 30490;

struct Config {
  // Our Ethernet address: unicast, unique on the segment.
  MacAddress mac;

  // Our IPv4 address: a host of its subnet.
  Ipv4Address address;

  // Leading bits that name the subnet, 8 to 30. There is no router, so nothing outside it can be
  // reached.
  std::uint8_t prefix_bits;

  // The only host that messages and ping replies are ever sent to: another host of the subnet.
  Ipv4Address peer;

  // UDP port of the peer that receives the messages, 1 to 65535.
  std::uint16_t peer_port;

  // UDP port that the messages come from, 1 to 65535.
  std::uint16_t source_port;

  // The instance of the service that is offered by SOME/IP service discovery, and whose port and
  // group are listened to then; 0: none is, and nothing but the above is known of the network.
  std::uint8_t service_instance = 0;
};

// What Host relies on. Meant for a static_assert beside the configuration.
[[nodiscard]] constexpr bool is_valid(const Config& config) {
  // The prefix comes first: the other checks shift by it.
  return config.prefix_bits >= 8 && config.prefix_bits <= 30 && config.mac.is_unicast() &&
         is_host_in_subnet(config.address, config.address, config.prefix_bits) &&
         is_host_in_subnet(config.peer, config.address, config.prefix_bits) &&
         config.peer != config.address && config.peer_port != 0 && config.source_port != 0;
}

}  // namespace iog::net
