// What Host answers on its own: ARP to the subnet, ping to the peer. And whom it learns from.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <span>

#include "net/ethernet.hpp"
#include "net/frames.hpp"
#include "net/host.hpp"
#include "net/sent_frames.hpp"

namespace iog::net::testing {
namespace {

constexpr std::uint64_t kSecondUs = 1'000'000;

// Offsets of RFC 826 behind the Ethernet header.
constexpr std::size_t kArpSenderMac = 22;
constexpr std::size_t kArpSenderAddress = 28;
constexpr std::size_t kArpTargetAddress = 38;

void put_address(Frame& frame, std::size_t offset, Ipv4Address address) {
  put_be16(frame, offset, address.value >> 16);
  put_be16(frame, offset + 2, address.value & 0xFFFF);
}

Frame arp_from(Ipv4Address sender) {
  Frame frame = linux_arp_request();
  put_address(frame, kArpSenderAddress, sender);
  return frame;
}

Frame ping_from(Ipv4Address source) {
  Frame frame = linux_ping();
  put_address(frame, kIpOffset + 12, source);
  fix_ip_checksum(frame);
  return frame;
}

TEST(HostArp, AnswersTheSubnetWithAUnicastToTheAsker) {
  Station station;
  station.resolve();
  Frame request = arp_from(ipv4(10, 0, 2, 77));
  request[kArpSenderMac + 5] = std::byte{0x77};
  static_cast<void>(station.take(request));
  EXPECT_EQ(only_sent(station), our_arp("020000000077", "0002", "020000000077 0a00024d"));
  EXPECT_EQ(station.host.counters().arp_answered, 1U);
  EXPECT_TRUE(station.conserved());
}

// RFC 5227, section 2.1.1: who wants our address asks with the sender 0.0.0.0.
TEST(HostArp, DefendsItsAddressAgainstAProbe) {
  Station station;
  station.resolve();
  static_cast<void>(station.take(arp_from(ipv4(0, 0, 0, 0))));
  EXPECT_EQ(station.port.take_sent().size(), 1U);
  EXPECT_EQ(station.host.counters().arp_answered, 1U);
}

TEST(HostArp, IgnoresWhatDoesNotAskForUs) {
  Station station;
  station.resolve();
  Frame other_target = arp_from(ipv4(10, 0, 2, 77));
  put_address(other_target, kArpTargetAddress, ipv4(10, 0, 2, 16));
  static_cast<void>(station.take(other_target));
  static_cast<void>(station.take(arp_from(ipv4(10, 0, 3, 77))));
  static_cast<void>(station.take(arp_from(ipv4(10, 0, 2, 255))));
  Frame group_sender = arp_from(ipv4(10, 0, 2, 77));
  group_sender[kArpSenderMac] = std::byte{0x01};
  static_cast<void>(station.take(group_sender));
  Frame nobody = linux_arp_request();
  for (std::size_t i = 0; i < 6; ++i) {
    nobody[kArpSenderMac + i] = std::byte{0};
  }
  static_cast<void>(station.take(nobody));
  EXPECT_EQ(station.dropped(Drop::kArpIgnored), 5U);
  Frame strange = linux_arp_request();
  strange[kIpOffset + 1] = std::byte{6};
  static_cast<void>(station.take(strange));
  EXPECT_EQ(station.dropped(Drop::kBadArp), 1U);
  EXPECT_TRUE(station.port.take_sent().empty());
  EXPECT_TRUE(station.conserved());
}

TEST(HostArp, CountsAnotherStationWithOurAddressAndDoesNotAnswerIt) {
  Station station;
  station.resolve();
  static_cast<void>(station.take(arp_from(kConfig.address)));
  EXPECT_EQ(station.dropped(Drop::kAddressConflict), 1U);
  EXPECT_TRUE(station.port.take_sent().empty());
  // Our own announcement, reflected by a hub, is no conflict.
  Frame reflected = arp_from(kConfig.address);
  reflected[kArpSenderMac + 5] = std::byte{0x0F};
  static_cast<void>(station.take(reflected));
  EXPECT_EQ(station.dropped(Drop::kAddressConflict), 1U);
  EXPECT_EQ(station.dropped(Drop::kArpIgnored), 1U);
}

TEST(HostArp, AsksForThePeerAtTheFirstPollThenOnceASecond) {
  Station station;
  EXPECT_FALSE(station.poll(0));
  EXPECT_EQ(only_sent(station), our_arp("ffffffffffff", "0001", "000000000000 0a000202"));
  for (std::uint64_t now_us = 0; now_us <= 10 * kSecondUs; now_us += 10'000) {
    static_cast<void>(station.poll(now_us));
  }
  EXPECT_EQ(station.port.take_sent().size(), 10U);
  EXPECT_EQ(station.host.counters().arp_requested, 11U);
}

TEST(HostArp, AsksAgain30SecondsAfterItHasHeardFromThePeer) {
  Station station;
  station.resolve();
  static_cast<void>(station.poll(29 * kSecondUs));
  EXPECT_TRUE(station.port.take_sent().empty());
  static_cast<void>(station.poll(30 * kSecondUs));
  EXPECT_EQ(station.port.take_sent().size(), 1U);
  EXPECT_TRUE(station.host.peer_known());
}

TEST(HostArp, LearnsFromThePeersAnswerAndFromItsQuestion) {
  Station by_reply;
  EXPECT_FALSE(by_reply.host.peer_known());
  static_cast<void>(by_reply.take(linux_arp_reply()));
  EXPECT_TRUE(by_reply.host.peer_known());
  EXPECT_EQ(by_reply.host.counters().arp_learned, 1U);
  Station by_request;
  static_cast<void>(by_request.take(linux_arp_request()));
  EXPECT_TRUE(by_request.host.peer_known());
  EXPECT_EQ(by_request.host.counters().arp_answered, 1U);
  EXPECT_TRUE(by_reply.conserved() && by_request.conserved());
}

TEST(HostArp, LearnsFromNobodyElse) {
  Station station;
  static_cast<void>(station.take(arp_from(ipv4(10, 0, 2, 3))));
  Frame group = linux_arp_reply();
  group[kArpSenderMac] = std::byte{0x03};
  static_cast<void>(station.take(group));
  Frame ourselves = linux_arp_reply();
  ourselves[kArpSenderMac + 5] = std::byte{0x0F};
  static_cast<void>(station.take(ourselves));
  static_cast<void>(station.take(linux_udp_even()));
  EXPECT_FALSE(station.host.peer_known());
  EXPECT_TRUE(station.conserved());
}

MacAddress reached(Station& station) {
  static_cast<void>(station.port.take_sent());
  EXPECT_TRUE(station.host.send_message(std::span<const std::byte>{}));
  return parse_ethernet(only_sent(station))->destination;
}

Frame spoofed(Frame arp) {
  arp[kArpSenderMac + 5] = std::byte{0x66};
  return arp;
}

// Unasked replies, questions and announcements of another station: the peer is asked, by name.
TEST(HostArp, AClaimOfThePeersAddressMovesNothingWhileThePeerAnswers) {
  Frame announcement = spoofed(linux_arp_request());
  put_address(announcement, kArpTargetAddress, kConfig.peer);
  for (const Frame& claim :
       {spoofed(linux_arp_reply()), spoofed(linux_arp_request()), announcement}) {
    Station station;
    station.resolve();
    static_cast<void>(station.take(claim, kSecondUs));
    static_cast<void>(station.port.take_sent());
    static_cast<void>(station.poll(kSecondUs + 1));
    EXPECT_EQ(only_sent(station), our_arp("020000000002", "0001", "000000000000 0a000202"));
    EXPECT_EQ(reached(station), kPeerMac);
    static_cast<void>(station.take(linux_arp_reply(), kSecondUs + 2));
    static_cast<void>(station.take(claim, kSecondUs + 3));
    EXPECT_EQ(reached(station), kPeerMac);
    EXPECT_TRUE(station.conserved());
  }
}

// A station has claimed the peer's address before the peer was known. The true peer's next datagram
// has everyone asked when the station does not answer, and its answer has the stream.
TEST(HostArp, ThePeersOwnTrafficWinsTheStreamBack) {
  Station station;
  static_cast<void>(station.take(spoofed(linux_arp_reply())));
  ASSERT_NE(reached(station), kPeerMac);
  ASSERT_TRUE(station.take(linux_udp_even(), 2 * kSecondUs));
  static_cast<void>(station.poll(2 * kSecondUs + 1));
  EXPECT_EQ(station.port.take_sent().size(), 1U);
  static_cast<void>(station.poll(3 * kSecondUs + 1));
  EXPECT_EQ(station.port.take_sent().size(), 1U);
  static_cast<void>(station.take(linux_arp_reply(), 3 * kSecondUs + 2));
  EXPECT_EQ(reached(station), kPeerMac);
  // The peer is heard where it is known: nobody is asked.
  ASSERT_TRUE(station.take(linux_udp_even(), 4 * kSecondUs));
  static_cast<void>(station.poll(4 * kSecondUs + 2));
  EXPECT_TRUE(station.port.take_sent().empty());
  EXPECT_TRUE(station.conserved());
}

// A router passes on what claims to be the peer's. It is asked once a second, and nothing goes to
// it.
TEST(HostArp, TrafficAloneMovesNothing) {
  Station station;
  station.resolve();
  Frame routed = linux_udp_even();
  routed[11] = std::byte{0x66};
  for (std::uint64_t now_us = kSecondUs; now_us < 4 * kSecondUs; now_us += 10'000) {
    ASSERT_TRUE(station.take(routed, now_us));
  }
  for (const Frame& frame : station.port.take_sent()) {
    EXPECT_EQ(be16(frame, 12), 0x0806U);
  }
  EXPECT_EQ(station.host.counters().arp_requested, 1U + 3U);
  // And everyone is asked all the same, when it is time to.
  ASSERT_TRUE(station.take(routed, 31 * kSecondUs));
  EXPECT_EQ(be16(only_sent(station), 0), 0xFFFFU);
}

// Our IPv4 identification and Don't Fragment are our own; all else is what Linux answers.
TEST(HostPing, AnswersThePeer) {
  Station station;
  station.resolve();
  static_cast<void>(station.take(linux_ping()));
  const Frame sent = only_sent(station);
  Frame expected = from_hex(
      "020000000002 02000000000f 0800"
      "4500 003c 0000 4000 4001 0000 0a00020f 0a000202"
      "0000 b144 a416 0001 6162636465666768696a6b6c6d6e6f7071727374757677616263646566676869");
  fix_ip_checksum(expected);
  EXPECT_EQ(sent, expected);
  EXPECT_EQ(station.host.counters().ping_answered, 1U);
  EXPECT_TRUE(station.conserved());
}

// A ping with this many bytes of data behind the ICMP header.
Frame ping_with(std::size_t data_bytes) {
  Frame ping = linux_ping();
  ping.resize(kUdpOffset + 8 + data_bytes, std::byte{0x5A});
  put_be16(ping, kIpOffset + 2, 28 + data_bytes);
  fix_ip_checksum(ping);
  put_be16(ping, kUdpOffset + 2, 0);
  put_be16(ping, kUdpOffset + 2, reference_checksum(std::span{ping}.subspan(kUdpOffset)));
  return ping;
}

TEST(HostPing, AnswersEveryLengthThatFitsAFrame) {
  Station station;
  station.resolve();
  for (std::size_t data = 0; data <= kMaxIpv4PayloadBytes - 8; ++data) {
    const Frame ping = ping_with(data);
    static_cast<void>(station.take(ping));
    station.port.pump();
    const Frame sent = only_sent(station);
    ASSERT_EQ(sent.size(), std::max(ping.size(), kMinFrameBytes));
    EXPECT_EQ(reference_checksum(std::span{sent}.subspan(kUdpOffset, 8 + data)), 0);
    EXPECT_EQ(be16(sent, kIpOffset + 4), data) << "identification counts packets";
  }
}

// A port may have larger receive buffers than transmit buffers.
TEST(HostPing, IgnoresWhatItCouldNotSendBack) {
  Station station;
  station.resolve();
  static_cast<void>(station.take(ping_with(kMaxIpv4PayloadBytes - 8 + 1)));
  EXPECT_EQ(station.dropped(Drop::kPingIgnored), 1U);
  EXPECT_TRUE(station.port.take_sent().empty());
}

TEST(HostPing, IgnoresOthersBroadcastsAndAnUnresolvedPeer) {
  Station station;
  static_cast<void>(station.take(linux_ping()));
  EXPECT_EQ(station.dropped(Drop::kPingIgnored), 1U) << "unresolved";
  station.resolve();
  static_cast<void>(station.take(ping_from(ipv4(10, 0, 2, 3))));
  EXPECT_EQ(station.dropped(Drop::kPingIgnored), 2U);
  Frame broadcast = linux_ping();
  put_address(broadcast, kIpOffset + 16, ipv4(10, 0, 2, 255));
  fix_ip_checksum(broadcast);
  static_cast<void>(station.take(broadcast));
  EXPECT_EQ(station.dropped(Drop::kPingIgnored), 3U);
  Frame reply = linux_ping();
  put_be16(reply, kUdpOffset, 0x0000);
  put_be16(reply, kUdpOffset + 2, 0xB144);
  static_cast<void>(station.take(reply));
  EXPECT_EQ(station.dropped(Drop::kIcmpIgnored), 1U);
  EXPECT_TRUE(station.port.take_sent().empty());
  EXPECT_TRUE(station.conserved());
}

// The reply goes to the station that ARP named, whatever source the ping's frame claims.
TEST(HostPing, RepliesOnlyToTheLearntAddress) {
  Station station;
  station.resolve();
  Frame ping = linux_ping();
  ping[11] = std::byte{0x66};
  static_cast<void>(station.take(ping));
  const Frame sent = only_sent(station);
  const auto ethernet = parse_ethernet(sent);
  ASSERT_TRUE(ethernet);
  EXPECT_EQ(ethernet->destination, kPeerMac);
}

TEST(HostReply, CountsAFullRing) {
  Station station;
  station.resolve();
  station.port.set_ring_slots(0);
  static_cast<void>(station.take(linux_ping()));
  static_cast<void>(station.take(linux_arp_request()));
  EXPECT_EQ(station.dropped(Drop::kReplyRingFull), 2U);
  EXPECT_TRUE(station.port.take_sent().empty());
  EXPECT_TRUE(station.conserved());
}

}  // namespace
}  // namespace iog::net::testing
