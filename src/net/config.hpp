// The network addresses of the target and its peer, as given in the car block of the image.
#pragma once

#include <cstdint>

#include "net/address.hpp"

namespace iog::net {

// The multicast group and port of service discovery. AUTOSAR PRS_SOMEIPServiceDiscoveryProtocol
// calls the group SD_MULTICAST_IP and the port SD_PORT.
inline constexpr Ipv4Address kDiscoveryGroup = ipv4(224, 244, 224, 245);
inline constexpr MacAddress kDiscoveryGroupMac = group_mac(kDiscoveryGroup);
inline constexpr std::uint16_t kDiscoveryPort = 30490;

struct Config {
  // The target's Ethernet address. The address must be unicast and unique on the segment.
  MacAddress mac;

  // The target's IPv4 address. The address must be a host address in the subnet.
  Ipv4Address address;

  // The length of the subnet prefix in bits, from 8 to 30. The network has no router, so hosts
  // outside the subnet are unreachable.
  std::uint8_t prefix_bits;

  // The only host to which the target sends messages and ping replies. The peer must be another
  // host in the subnet.
  Ipv4Address peer;

  // The peer's UDP port for messages, from 1 to 65535.
  std::uint16_t peer_port;

  // The target's UDP source port for messages, from 1 to 65535.
  std::uint16_t source_port;

  // The instance ID of the service offered through SOME/IP service discovery. If the ID is not 0,
  // the target also listens on the discovery port and joins the discovery group. If the ID is 0,
  // service discovery is disabled.
  std::uint8_t service_instance = 0;
};

// Returns true if the configuration meets the preconditions of Host. Check is_valid() in a
// static_assert next to the configuration.
[[nodiscard]] constexpr bool is_valid(const Config& config) {
  // The prefix must be checked first because the other checks use it as a shift count.
  return config.prefix_bits >= 8 && config.prefix_bits <= 30 && config.mac.is_unicast() &&
         is_host_in_subnet(config.address, config.address, config.prefix_bits) &&
         is_host_in_subnet(config.peer, config.address, config.prefix_bits) &&
         config.peer != config.address && config.peer_port != 0 && config.source_port != 0;
}

}  // namespace iog::net
