// Network addresses of the target and its peer, from the car block of the image.
#pragma once

#include <cstdint>

#include "net/address.hpp"

namespace iog::net {

// Multicast group and port of service discovery. AUTOSAR PRS_SOMEIPServiceDiscoveryProtocol calls
// them SD_MULTICAST_IP and SD_PORT; these are their usual values.
inline constexpr Ipv4Address kDiscoveryGroup = ipv4(224, 244, 224, 245);
inline constexpr MacAddress kDiscoveryGroupMac = group_mac(kDiscoveryGroup);
inline constexpr std::uint16_t kDiscoveryPort = 30490;

struct Config {
  // Our Ethernet address: unicast, unique on the segment.
  MacAddress mac;

  // Our IPv4 address: a host address of the subnet.
  Ipv4Address address;

  // Length of the subnet prefix, 8 to 30. There is no router: hosts outside the subnet are
  // unreachable.
  std::uint8_t prefix_bits;

  // The only host that receives messages and ping replies: another host of the subnet.
  Ipv4Address peer;

  // The peer's UDP port for messages, 1 to 65535.
  std::uint16_t peer_port;

  // Our UDP source port for messages, 1 to 65535.
  std::uint16_t source_port;

  // Instance ID of the service offered through SOME/IP service discovery. If it is not 0, the
  // target also listens to the discovery port and group. 0 disables service discovery.
  std::uint8_t service_instance = 0;
};

// The preconditions of Host. Use it in a static_assert next to the configuration.
[[nodiscard]] constexpr bool is_valid(const Config& config) {
  // Check the prefix first: the other checks shift by it.
  return config.prefix_bits >= 8 && config.prefix_bits <= 30 && config.mac.is_unicast() &&
         is_host_in_subnet(config.address, config.address, config.prefix_bits) &&
         is_host_in_subnet(config.peer, config.address, config.prefix_bits) &&
         config.peer != config.address && config.peer_port != 0 && config.source_port != 0;
}

}  // namespace iog::net
