// Value types for Ethernet and IPv4 addresses.
#pragma once

#include <array>
#include <cstdint>

namespace iog::net {

// A 48-bit Ethernet address, with the octets in wire order.
struct MacAddress {
  std::array<std::uint8_t, 6> octets{};

  friend constexpr bool operator==(const MacAddress&, const MacAddress&) = default;

  // Returns false for the all-zero address and for group addresses. In a group address, the lowest
  // bit of the first octet is set.
  [[nodiscard]] constexpr bool is_unicast() const {
    return (octets[0] & 1U) == 0 && *this != MacAddress{};
  }
};

inline constexpr MacAddress kBroadcastMac{{0xFF, 0xFF, 0xFF, 0xFF, 0xFF, 0xFF}};

// An IPv4 address in host byte order. For example, 10.0.2.15 is 0x0A00020F on every machine.
struct Ipv4Address {
  std::uint32_t value = 0;

  friend constexpr bool operator==(Ipv4Address, Ipv4Address) = default;
};

[[nodiscard]] constexpr Ipv4Address ipv4(std::uint8_t a, std::uint8_t b, std::uint8_t c,
                                         std::uint8_t d) {
  return {std::uint32_t{a} << 24 | std::uint32_t{b} << 16 | std::uint32_t{c} << 8 | d};
}

inline constexpr Ipv4Address kLimitedBroadcast = ipv4(255, 255, 255, 255);

// Returns the mask of the host bits. Requires 1 <= prefix_bits <= 32.
[[nodiscard]] constexpr std::uint32_t host_mask(std::uint8_t prefix_bits) {
  return (std::uint32_t{1} << (32 - prefix_bits)) - 1;
}

[[nodiscard]] constexpr bool same_subnet(Ipv4Address left, Ipv4Address right,
                                         std::uint8_t prefix_bits) {
  return ((left.value ^ right.value) & ~host_mask(prefix_bits)) == 0;
}

// Returns the broadcast address of the subnet that contains `address`, such as 10.0.2.255 (RFC
// 919).
[[nodiscard]] constexpr Ipv4Address directed_broadcast(Ipv4Address address,
                                                       std::uint8_t prefix_bits) {
  return {address.value | host_mask(prefix_bits)};
}

// Returns true for multicast addresses. `group_mac()` returns the Ethernet address of a multicast
// group (RFC 1112, section 6.4).
[[nodiscard]] constexpr bool is_group(Ipv4Address address) { return address.value >> 28 == 0xE; }

[[nodiscard]] constexpr MacAddress group_mac(Ipv4Address group) {
  return {{0x01, 0x00, 0x5E, static_cast<std::uint8_t>(group.value >> 16 & 0x7FU),
           static_cast<std::uint8_t>(group.value >> 8), static_cast<std::uint8_t>(group.value)}};
}

// Returns true if the address can be the unicast address of a host. The ranges 0/8 ("this
// network"), 127/8 (loopback) and 224/3 (multicast, reserved, limited broadcast) are excluded. See
// RFC 1122, section 3.2.1.3.
[[nodiscard]] constexpr bool is_host_address(Ipv4Address address) {
  const std::uint32_t network = address.value >> 24;
  return network != 0 && network != 127 && network < 224;
}

// Returns true if `address` is a host address in the same subnet as `member`. The network address
// and the broadcast address of the subnet are not host addresses.
[[nodiscard]] constexpr bool is_host_in_subnet(Ipv4Address address, Ipv4Address member,
                                               std::uint8_t prefix_bits) {
  const std::uint32_t host = address.value & host_mask(prefix_bits);
  return is_host_address(address) && same_subnet(address, member, prefix_bits) && host != 0 &&
         host != host_mask(prefix_bits);
}

}  // namespace iog::net
