// Frames that other people's network stacks have made, and a slow reference checksum.
//
// Those of the Linux kernel were read from a TAP device on which kernel 10.0.2.2
// (02:00:00:00:00:02) talked to 10.0.2.15 (02:00:00:00:00:0f), which is us.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "fakes/from_hex.hpp"
#include "net/config.hpp"

namespace iog::net::testing {

using Frame = std::vector<std::byte>;

inline constexpr Config kConfig{.mac = {{0x02, 0, 0, 0, 0, 0x0F}},
                                .address = ipv4(10, 0, 2, 15),
                                .prefix_bits = 24,
                                .peer = ipv4(10, 0, 2, 2),
                                .peer_port = 19000,
                                .source_port = 7001};
static_assert(is_valid(kConfig));

inline constexpr MacAddress kPeerMac{{0x02, 0, 0, 0, 0, 0x02}};

using tests::from_hex;

inline std::string_view text_of(std::span<const std::byte> bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// RFC 1071 read literally: 16-bit words one by one, each carry added back at once.
inline std::uint16_t reference_checksum(std::span<const std::byte> bytes) {
  unsigned sum = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    sum += std::to_integer<unsigned>(bytes[i]) << (i % 2 == 0 ? 8 : 0);
    sum = (sum & 0xFFFFU) + (sum >> 16);
  }
  return static_cast<std::uint16_t>(~sum);
}

inline void put_be16(Frame& frame, std::size_t offset, std::size_t value) {
  frame[offset] = static_cast<std::byte>(value >> 8);
  frame[offset + 1] = static_cast<std::byte>(value);
}

inline unsigned be16(const Frame& frame, std::size_t offset) {
  return std::to_integer<unsigned>(frame[offset]) << 8 |
         std::to_integer<unsigned>(frame[offset + 1]);
}

inline constexpr std::size_t kIpOffset = 14;
inline constexpr std::size_t kIpChecksumOffset = 24;
inline constexpr std::size_t kUdpOffset = 34;
inline constexpr std::size_t kUdpChecksumOffset = 40;
inline constexpr std::size_t kPayloadOffset = 42;

// Makes the IPv4 header checksum right again after a change; the header has no options.
inline void fix_ip_checksum(Frame& frame) {
  put_be16(frame, kIpChecksumOffset, 0);
  put_be16(frame, kIpChecksumOffset, reference_checksum(std::span{frame}.subspan(kIpOffset, 20)));
}

// "iogrid" and "occupancy grid!" from port 19000 of the peer to our port 7000 (Linux).
inline Frame linux_udp_even() {
  return from_hex(
      "02000000000f 020000000002 0800"
      "4500 0022 73e5 4000 4011 aed5 0a000202 0a00020f"
      "4a38 1b58 000e 47eb 696f67726964");
}
inline Frame linux_udp_odd() {
  return from_hex(
      "02000000000f 020000000002 0800"
      "4500 002b 7411 4000 4011 aea0 0a000202 0a00020f"
      "4a38 1b58 0017 658a 6f63637570616e6379206772696421");
}

// "x" to 10.0.2.255, port 2368 (Linux).
inline Frame linux_udp_subnet_broadcast() {
  return from_hex(
      "ffffffffffff 020000000002 0800"
      "4500 001d 24e6 4000 4011 fce9 0a000202 0a0002ff"
      "4a38 0940 0009 1b63 78");
}

// The second fragment of a datagram of 600 z (Linux).
inline Frame linux_last_fragment() {
  Frame frame = from_hex(
      "02000000000f 020000000002 0800"
      "4500 004c 74d0 0045 4011 ed7b 0a000202 0a00020f");
  frame.resize(frame.size() + 56, std::byte{'z'});
  return frame;
}

// Who has 10.0.2.15? Tell 10.0.2.2 (Linux).
inline Frame linux_arp_request() {
  return from_hex(
      "ffffffffffff 020000000002 0806 0001 0800 06 04 0001"
      "020000000002 0a000202 000000000000 0a00020f");
}

// The answer to our own question for 10.0.2.2 (Linux).
inline Frame linux_arp_reply() {
  return from_hex(
      "02000000000f 020000000002 0806 0001 0800 06 04 0002"
      "020000000002 0a000202 02000000000f 0a00020f");
}

// Echo request to us, identifier a416 (Linux).
inline Frame linux_ping() {
  return from_hex(
      "02000000000f 020000000002 0800"
      "4500 003c 882f 4000 4001 9a81 0a000202 0a00020f"
      "0800 a944 a416 0001 6162636465666768696a6b6c6d6e6f7071727374757677616263646566676869");
}

// Echo reply to us, to a ping with identifier 1234 (Linux).
inline Frame linux_ping_reply() {
  return from_hex(
      "02000000000f 020000000002 0800"
      "4500 003c 8832 0000 4001 da7e 0a000202 0a00020f"
      "0000 4321 1234 0007 6162636465666768696a6b6c6d6e6f7071727374757677616263646566676869");
}

// The front of the first packet of a public VLP-16 recording (vlp16_street_1rev.pcap of
// jerry73204/rust-lidar-utils), broadcast by 192.168.1.200 with the UDP checksum 0; the 1206 bytes
// of the payload are zeros here, as nothing sums them.
inline Frame velodyne_broadcast() {
  Frame frame = from_hex(
      "ffffffffffff 607688000000 0800"
      "4500 04d2 0000 4000 ff11 b4aa c0a801c8 ffffffff"
      "0940 0940 04be 0000");
  frame.resize(kPayloadOffset + 1206);
  return frame;
}

}  // namespace iog::net::testing
