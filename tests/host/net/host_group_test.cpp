// What a host does for service discovery: it listens to a group, sends to whom it is told, and asks
// ARP for one host more. One that offers no service does none of it.
#include <gtest/gtest.h>

#include "net/frames.hpp"
#include "net/sent_frames.hpp"

namespace iog::net::testing {
namespace {

constexpr Config offering() {
  Config config = kConfig;
  config.service_instance = 1;
  return config;
}

struct OfferingStation : Station {
  OfferingStation() : Station(offering()) {}
};

// RFC 1112, section 6.4: 01:00:5e and the lower 23 bits of the group.
Frame to_group() {
  Frame frame = linux_udp_even();
  const Frame group = from_hex("01005e74e0f5");
  std::copy(group.begin(), group.end(), frame.begin());
  put_be16(frame, kIpOffset + 16, 0xE0F4);
  put_be16(frame, kIpOffset + 18, 0xE0F5);
  fix_ip_checksum(frame);
  put_be16(frame, kUdpOffset + 2, 30'490);
  put_be16(frame, kUdpChecksumOffset, 0);
  return frame;
}

TEST(HostGroup, IsHeardOnlyByWhoOffersAService) {
  Station silent;
  EXPECT_FALSE(silent.take(to_group()));
  EXPECT_EQ(silent.dropped(Drop::kNotForUsMac), 1U);
  OfferingStation station;
  const auto datagram = station.take(to_group());
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->destination, ipv4(224, 244, 224, 245));
  EXPECT_EQ(datagram->destination_port, kDiscoveryPort);
  EXPECT_EQ(datagram->source, kConfig.peer);
  EXPECT_EQ(datagram->station, kPeerMac);
  EXPECT_EQ(text_of(datagram->payload), "iogrid");
}

// The bin of a filter holds many groups: what is for another is dropped here.
TEST(HostGroup, IsTheOnlyOne) {
  OfferingStation station;
  Frame other_mac = to_group();
  other_mac[5] = std::byte{0xF6};
  EXPECT_FALSE(station.take(other_mac));
  EXPECT_EQ(station.host.counters().of(Drop::kNotForUsMac), 1U);
  Frame other_address = to_group();
  put_be16(other_address, kIpOffset + 16, 0xE074);  // the same Ethernet address
  fix_ip_checksum(other_address);
  EXPECT_FALSE(station.take(other_address));
  EXPECT_EQ(station.host.counters().of(Drop::kNotForUsIp), 1U);
}

TEST(HostGroup, ADatagramSaysWhereItWasSent) {
  OfferingStation station;
  EXPECT_EQ(station.take(linux_udp_even())->destination, kConfig.address);
  EXPECT_EQ(station.take(linux_udp_subnet_broadcast())->destination, ipv4(10, 0, 2, 255));
}

// The reply that Linux would read: the very frame of the peer, sent back.
TEST(HostGroup, SendsToWhomItIsTold) {
  OfferingStation station;
  static_cast<void>(station.host.poll(0));
  static_cast<void>(station.port.take_sent());
  const Frame received = linux_udp_even();
  ASSERT_TRUE(station.host.send_to({.mac = {{2, 0, 0, 0, 0, 0x4D}},
                                    .address = ipv4(10, 0, 2, 77),
                                    .port = 30'500,
                                    .source_port = 7001},
                                   std::span(received).subspan(kPayloadOffset)));
  const Frame sent = only_sent(station);
  Frame expected = from_hex(
      "02000000004d 02000000000f 0800"
      "4500 0022 0000 4000 4011 0000 0a00020f 0a00024d"
      "1b59 7724 000e 0000 696f67726964");
  fix_ip_checksum(expected);
  put_be16(expected, kUdpChecksumOffset, be16(sent, kUdpChecksumOffset));
  expected.resize(kMinFrameBytes);
  EXPECT_EQ(sent, expected);
  EXPECT_EQ(station.host.counters().sent, 0U) << "that counts what the peer gets";
}

Frame answer_of_neighbour() {
  Frame answer = linux_arp_reply();
  answer[11] = answer[27] = std::byte{0x4D};
  answer[31] = std::byte{77};
  return answer;
}

TEST(HostGroup, KnowsOneHostMoreByArp) {
  OfferingStation station;
  static_cast<void>(station.take(linux_arp_reply()));
  static_cast<void>(station.port.take_sent());
  EXPECT_FALSE(station.take(answer_of_neighbour(), 10));
  EXPECT_FALSE(station.host.neighbour()) << "nobody wants to know";
  station.host.know(ipv4(10, 0, 2, 77));
  static_cast<void>(station.host.poll(20));
  EXPECT_EQ(only_sent(station), our_arp("ffffffffffff", "0001", "000000000000 0a00024d"));
  EXPECT_FALSE(station.host.neighbour());
  static_cast<void>(station.take(answer_of_neighbour(), 30));
  ASSERT_TRUE(station.host.neighbour());
  EXPECT_EQ(station.host.neighbour()->mac, (MacAddress{{2, 0, 0, 0, 0, 0x4D}}));
  EXPECT_EQ(station.host.neighbour()->at_us, 30U);
  EXPECT_EQ(station.host.counters().arp_learned, 2U);
  station.host.know(ipv4(10, 0, 2, 77));
  EXPECT_TRUE(station.host.neighbour()) << "the same one";
  station.host.know(ipv4(10, 0, 2, 78));
  EXPECT_FALSE(station.host.neighbour());
  station.host.know(std::nullopt);
  EXPECT_FALSE(station.host.neighbour());
}

}  // namespace
}  // namespace iog::net::testing
