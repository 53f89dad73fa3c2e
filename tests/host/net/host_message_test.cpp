// Messages to the peer: their headers, and when there are none.
#include <algorithm>
#include <cstddef>
#include <gtest/gtest.h>
#include <set>
#include <span>

#include "net/frames.hpp"
#include "net/host.hpp"
#include "net/sent_frames.hpp"

namespace iog::net::testing {
namespace {

// RFC 768: the checksum is over the addresses, 0, 17, the UDP length and the datagram.
bool has_right_udp_checksum(const Frame& frame) {
  const std::size_t length = be16(frame, kUdpOffset + 4);
  Frame summed(frame.begin() + kIpOffset + 12, frame.begin() + kUdpOffset);
  summed.resize(12);
  put_be16(summed, 8, 17);
  put_be16(summed, 10, length);
  const auto datagram = std::span{frame}.subspan(kUdpOffset, length);
  summed.insert(summed.end(), datagram.begin(), datagram.end());
  return reference_checksum(summed) == 0;
}

Frame send(Station& station, std::span<const std::byte> payload) {
  EXPECT_TRUE(station.host.send_message(payload));
  station.port.pump();
  return only_sent(station);
}

TEST(HostMessage, IsAddressedToThePeer) {
  Station station;
  station.resolve();
  const Frame payload = from_hex("00112233445566778899aabbccddeeff");
  const Frame frame = send(station, payload);
  Frame expected = from_hex(
      "020000000002 02000000000f 0800"
      "4500 002c 0000 4000 4011 0000 0a00020f 0a000202"
      "1b59 4a38 0018 0000");
  fix_ip_checksum(expected);
  ASSERT_EQ(frame.size(), kMinFrameBytes);
  put_be16(expected, kUdpChecksumOffset, be16(frame, kUdpChecksumOffset));
  expected.insert(expected.end(), payload.begin(), payload.end());
  expected.resize(kMinFrameBytes);
  EXPECT_EQ(frame, expected);
  EXPECT_TRUE(has_right_udp_checksum(frame));
  EXPECT_EQ(station.host.counters().sent, 1U);
}

TEST(HostMessage, OfEveryLengthIsWellFormed) {
  Station station;
  station.resolve();
  for (std::size_t size = 0; size <= kMaxUdpPayloadBytes; ++size) {
    const Frame payload(size, static_cast<std::byte>(size + 1));
    const Frame frame = send(station, payload);
    ASSERT_EQ(frame.size(), std::max(kPayloadOffset + size, kMinFrameBytes));
    ASSERT_EQ(be16(frame, kIpOffset + 2), 28 + size);
    ASSERT_EQ(be16(frame, kIpOffset + 4), size) << "identification counts packets";
    ASSERT_EQ(reference_checksum(std::span{frame}.subspan(kIpOffset, 20)), 0);
    ASSERT_EQ(be16(frame, kUdpOffset + 4), 8 + size);
    ASSERT_TRUE(has_right_udp_checksum(frame)) << size;
    ASSERT_TRUE(std::equal(payload.begin(), payload.end(), frame.begin() + kPayloadOffset));
    // Behind a short message lie zeros and not what the buffer held before.
    ASSERT_TRUE(std::all_of(frame.begin() + static_cast<std::ptrdiff_t>(kPayloadOffset + size),
                            frame.end(), [](std::byte byte) { return byte == std::byte{0}; }));
  }
}

// Over all values of one word the checksum takes all values but 0, which means "no checksum".
TEST(HostMessage, NeverCarriesTheChecksumZero) {
  Station station;
  station.resolve();
  std::set<unsigned> seen;
  for (unsigned word = 0; word <= 0xFFFF; ++word) {
    Frame payload(2);
    put_be16(payload, 0, word);
    const Frame frame = send(station, payload);
    ASSERT_TRUE(has_right_udp_checksum(frame)) << word;
    seen.insert(be16(frame, kUdpChecksumOffset));
  }
  EXPECT_EQ(seen.count(0), 0U);
  EXPECT_EQ(seen.count(0xFFFF), 1U);
  EXPECT_EQ(seen.size(), 0xFFFFU);
}

TEST(HostMessage, IsRefusedWhileThePeerIsUnresolved) {
  Station station;
  static_cast<void>(station.poll());
  static_cast<void>(station.port.take_sent());
  EXPECT_FALSE(station.host.send_message(Frame(10)));
  EXPECT_EQ(station.refused(Refusal::kUnresolved), 1U);
  EXPECT_EQ(station.host.counters().sent, 0U);
  EXPECT_TRUE(station.port.take_sent().empty());
}

TEST(HostMessage, IsRefusedWhileTheRingIsFull) {
  Station station;
  station.resolve();
  station.port.pump();
  station.port.set_ring_slots(2);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(station.host.send_message(Frame(4)), i < 2);
  }
  EXPECT_EQ(station.host.counters().sent, 2U);
  EXPECT_EQ(station.refused(Refusal::kRingFull), 3U);
  station.port.pump();
  EXPECT_TRUE(station.host.send_message(Frame(4)));
  EXPECT_TRUE(station.conserved());
}

// Nor to anybody else who is told to get it.
TEST(HostMessage, TooLongIsNotSentElsewhere) {
  Station station;
  station.resolve();
  const Destination elsewhere{
      .mac = kPeerMac, .address = kConfig.peer, .port = 9, .source_port = 10};
  EXPECT_FALSE(station.host.send_to(elsewhere, Frame(kMaxUdpPayloadBytes + 1)));
  EXPECT_EQ(station.refused(Refusal::kMisuse), 1U);
  EXPECT_TRUE(station.port.take_sent().empty());
  EXPECT_TRUE(station.host.send_to(elsewhere, Frame(kMaxUdpPayloadBytes)));
  EXPECT_EQ(station.port.take_sent().size(), 1U);
}

TEST(HostMessage, TooLongIsNotSent) {
  Station station;
  station.resolve();
  EXPECT_FALSE(station.host.send_message(Frame(kMaxUdpPayloadBytes + 1)));
  EXPECT_EQ(station.refused(Refusal::kMisuse), 1U);
  EXPECT_TRUE(station.port.take_sent().empty());
  EXPECT_TRUE(station.host.send_message(Frame(kMaxUdpPayloadBytes)));
  EXPECT_EQ(station.port.take_sent().size(), 1U);
}

TEST(HostMessage, FollowsThePeerToItsNewAddress) {
  Station station;
  station.resolve();
  Frame moved = linux_arp_reply();
  moved[27] = std::byte{0x99};
  static_cast<void>(station.take(moved));
  static_cast<void>(station.poll(1'000'000));  // asks where it was
  static_cast<void>(station.poll(2'000'000));  // asks everyone
  static_cast<void>(station.port.take_sent());
  static_cast<void>(station.take(moved, 2'000'001));
  const Frame frame = send(station, from_hex("00"));
  EXPECT_EQ(frame[5], std::byte{0x99});
}

}  // namespace
}  // namespace iog::net::testing
