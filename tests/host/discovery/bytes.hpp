// Messages of service discovery as another implementation makes them: scapy 2.5 of Debian
// (scapy.contrib.automotive.someip), and hosts that send them.
#pragma once

#include "net/frames.hpp"
#include "net/udp.hpp"

namespace iog::discovery::testing {

using net::testing::Frame;
using net::testing::from_hex;
using net::testing::kConfig;

// Who has a service 0x4F47, whatever its instance and version; session 1, flags reboot and unicast.
inline Frame scapy_find() {
  return from_hex(
      "ffff8100 00000024 00000001 01010200 c0000000 00000010"
      "00000000 4f47ffff ff000003 ffffffff 00000000");
}

// A subscription to event group 1 of instance 1, version 5, for 3 s, counter 5, at 10.0.2.77:30500;
// session 2.
inline Frame scapy_subscribe() {
  return from_hex(
      "ffff8100 00000030 00000002 01010200 c0000000 00000010"
      "06000010 4f470001 05000003 00050001 0000000c"
      "00090400 0a00024d 00117724");
}

// What answers the two, from 10.0.2.15:7001: an offer and an acknowledgement, session 1.
inline Frame scapy_offer() {
  return from_hex(
      "ffff8100 00000030 00000001 01010200 c0000000 00000010"
      "01000010 4f470001 05000003 00000000 0000000c"
      "00090400 0a00020f 00111b59");
}
inline Frame scapy_acknowledgement() {
  return from_hex(
      "ffff8100 00000024 00000001 01010200 c0000000 00000010"
      "07000000 4f470001 05000003 00050001 00000000");
}

// Where fields of the two are.
inline constexpr std::size_t kSessionAt = 10;
inline constexpr std::size_t kFlagsAt = 16;
inline constexpr std::size_t kEntriesAt = 20;
inline constexpr std::size_t kEntryAt = 24;
inline constexpr std::size_t kTtlAt = kEntryAt + 9;
inline constexpr std::size_t kOptionAt = 44;
inline constexpr std::size_t kAddressAt = kOptionAt + 4;

inline constexpr net::Ipv4Address kSubscriber = net::ipv4(10, 0, 2, 77);
inline constexpr net::MacAddress kStation{{0x02, 0, 0, 0, 0, 0x4D}};

}  // namespace iog::discovery::testing
