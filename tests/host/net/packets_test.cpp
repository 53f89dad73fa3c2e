// Each header alone: what it accepts, what it refuses and why, and that what we build is byte for
// byte what the Linux kernel builds in our place.
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <span>

#include "net/arp.hpp"
#include "net/ethernet.hpp"
#include "net/frames.hpp"
#include "net/icmp.hpp"
#include "net/ipv4.hpp"
#include "net/outbound.hpp"
#include "net/udp.hpp"

namespace iog::net::testing {
namespace {

// The kernel's side of the wire: what it sends is what we would send in its place.
constexpr Config kLinux{.mac = kPeerMac,
                        .address = kConfig.peer,
                        .prefix_bits = 24,
                        .peer = kConfig.address,
                        .peer_port = 7000,
                        .source_port = 19000};

// A frame built into a dirty buffer, cut to the length that would be committed.
template <typename Build>
Frame built(Build build) {
  Frame buffer(kMaxFrameBytes, std::byte{0xEE});
  buffer.resize(build(FrameBuffer{buffer}));
  return buffer;
}

Frame padded(Frame frame) {
  if (frame.size() < kMinFrameBytes) {
    frame.resize(kMinFrameBytes);
  }
  return frame;
}

std::span<const std::byte> ip_of(const Frame& frame) { return std::span{frame}.subspan(kIpOffset); }

Ipv4Status status_of(const Frame& frame) { return parse_ipv4(ip_of(frame)).status; }

TEST(Ethernet, TakesTheHeaderApart) {
  const Frame frame = linux_arp_request();
  const auto parsed = parse_ethernet(frame);
  ASSERT_TRUE(parsed);
  EXPECT_EQ(parsed->destination, kBroadcastMac);
  EXPECT_EQ(parsed->source, kPeerMac);
  EXPECT_EQ(parsed->type, kEtherTypeArp);
  EXPECT_EQ(parsed->payload.size(), kArpPacketBytes);
  EXPECT_FALSE(parse_ethernet(std::span{frame}.first(13)));
  EXPECT_TRUE(parse_ethernet(std::span{frame}.first(14)));
}

TEST(Ipv4, TakesTheHeaderApart) {
  const Frame frame = linux_udp_even();
  const Ipv4Result result = parse_ipv4(ip_of(frame));
  ASSERT_EQ(result.status, Ipv4Status::kOk);
  EXPECT_EQ(result.packet.source, ipv4(10, 0, 2, 2));
  EXPECT_EQ(result.packet.destination, ipv4(10, 0, 2, 15));
  EXPECT_EQ(result.packet.protocol, kProtocolUdp);
  EXPECT_EQ(result.packet.payload.data(), frame.data() + kUdpOffset);
  EXPECT_EQ(result.packet.payload.size(), 14U);
}

TEST(Ipv4, CutsPaddingOff) {
  Frame frame = linux_udp_even();
  frame.resize(60, std::byte{0xAA});
  EXPECT_EQ(parse_ipv4(ip_of(frame)).packet.payload.size(), 14U);
}

// RFC 791, section 3.1: the header length counts words of 32 bits, options included.
TEST(Ipv4, SkipsOptions) {
  for (unsigned words = 6; words <= 15; ++words) {
    Frame frame = linux_udp_even();
    const std::size_t option_bytes = (words - 5) * std::size_t{4};
    frame.insert(frame.begin() + kUdpOffset, option_bytes, std::byte{1});  // no operation
    frame[kIpOffset] = static_cast<std::byte>(0x40 | words);
    put_be16(frame, kIpOffset + 2, 34 + option_bytes);
    put_be16(frame, kIpChecksumOffset, 0);
    const auto header = std::span{frame}.subspan(kIpOffset, 20 + option_bytes);
    put_be16(frame, kIpChecksumOffset, reference_checksum(header));
    const Ipv4Result result = parse_ipv4(ip_of(frame));
    ASSERT_EQ(result.status, Ipv4Status::kOk) << words;
    EXPECT_EQ(text_of(result.packet.payload.subspan(8)), "iogrid");
  }
}

TEST(Ipv4, RefusesHeadersThatContradictThemselvesEvenWithARightChecksum) {
  const auto status_with = [](std::size_t offset, unsigned value) {
    Frame frame = linux_udp_even();
    put_be16(frame, offset, value);
    fix_ip_checksum(frame);
    return status_of(frame);
  };
  EXPECT_EQ(status_with(kIpOffset, 0x6500), Ipv4Status::kBadHeader) << "version";
  EXPECT_EQ(status_with(kIpOffset, 0x4400), Ipv4Status::kBadHeader) << "header of 16 bytes";
  EXPECT_EQ(status_with(kIpOffset, 0x4F00), Ipv4Status::kBadHeader) << "header beyond the packet";
  EXPECT_EQ(status_with(kIpOffset + 2, 19), Ipv4Status::kBadHeader) << "total below the header";
  EXPECT_EQ(status_with(kIpOffset + 2, 35), Ipv4Status::kBadHeader) << "total beyond the frame";
  EXPECT_EQ(status_with(kIpOffset + 2, 0xFFFF), Ipv4Status::kBadHeader);
  EXPECT_EQ(status_with(kIpOffset + 2, 20), Ipv4Status::kOk) << "an empty packet is a packet";
}

TEST(Ipv4, TellsFragmentsFromWholeDatagrams) {
  const auto status_with_flags = [](unsigned flags) {
    Frame frame = linux_udp_even();
    put_be16(frame, kIpOffset + 6, flags);
    fix_ip_checksum(frame);
    return status_of(frame);
  };
  EXPECT_EQ(status_of(linux_last_fragment()), Ipv4Status::kFragment);
  EXPECT_EQ(status_with_flags(0x2000), Ipv4Status::kFragment) << "the first of several";
  EXPECT_EQ(status_with_flags(0x1FFF), Ipv4Status::kFragment);
  EXPECT_EQ(status_with_flags(0x0001), Ipv4Status::kFragment);
  EXPECT_EQ(status_with_flags(0x4000), Ipv4Status::kOk) << "Don't Fragment";
  EXPECT_EQ(status_with_flags(0x0000), Ipv4Status::kOk);
}

TEST(Ipv4, SaysWhereAFragmentBelongs) {
  const Ipv4Packet packet = parse_ipv4(ip_of(linux_last_fragment())).packet;
  EXPECT_EQ(packet.identification, 0x74D0);
  EXPECT_EQ(packet.fragment_offset, 0x45U * 8);
  EXPECT_FALSE(packet.has_more_fragments);
  EXPECT_EQ(packet.payload.size(), 56U);
}

UdpResult udp_of(const Frame& frame) { return parse_udp(parse_ipv4(ip_of(frame)).packet); }

TEST(Udp, TakesTheDatagramsOfOthersApart) {
  const Frame even = linux_udp_even();
  const UdpResult result = udp_of(even);
  ASSERT_EQ(result.status, UdpStatus::kOk);
  EXPECT_EQ(result.datagram.source, ipv4(10, 0, 2, 2));
  EXPECT_EQ(result.datagram.source_port, 19000);
  EXPECT_EQ(result.datagram.destination_port, 7000);
  EXPECT_EQ(text_of(result.datagram.payload), "iogrid");
  const Frame odd = linux_udp_odd();
  ASSERT_EQ(udp_of(odd).status, UdpStatus::kOk);
  EXPECT_EQ(text_of(udp_of(odd).datagram.payload), "occupancy grid!");
}

TEST(Udp, TakesZeroForNoChecksum) {
  Frame frame = velodyne_broadcast();
  frame.back() = std::byte{0x37};
  const UdpResult result = udp_of(frame);
  ASSERT_EQ(result.status, UdpStatus::kOk);
  EXPECT_EQ(result.datagram.source, ipv4(192, 168, 1, 200));
  EXPECT_EQ(result.datagram.destination_port, 2368);
  EXPECT_EQ(result.datagram.payload.size(), 1206U);
}

TEST(Udp, BelievesALengthOnlyBetweenItsHeaderAndThePacket) {
  for (unsigned length = 0; length <= 0xFFFF; ++length) {
    Frame frame = linux_udp_even();
    put_be16(frame, kUdpOffset + 4, length);
    put_be16(frame, kUdpChecksumOffset, 0);
    const UdpResult result = udp_of(frame);
    if (length < 8 || length > 14) {
      ASSERT_EQ(result.status, UdpStatus::kBadLength) << length;
    } else {
      ASSERT_EQ(result.status, UdpStatus::kOk) << length;
      EXPECT_EQ(result.datagram.payload.size(), length - 8);
    }
  }
}

TEST(Udp, RefusesAWrongChecksum) {
  Frame frame = linux_udp_odd();
  frame.back() ^= std::byte{0x40};
  EXPECT_EQ(udp_of(frame).status, UdpStatus::kBadChecksum);
  // The pseudo header is part of it: the same datagram from another host is wrong.
  const Frame right = linux_udp_odd();
  Ipv4Packet packet = parse_ipv4(ip_of(right)).packet;
  packet.source = ipv4(10, 0, 2, 3);
  EXPECT_EQ(parse_udp(packet).status, UdpStatus::kBadChecksum);
}

TEST(Arp, TakesThePacketOfAnotherApart) {
  const Frame frame = linux_arp_reply();
  const auto packet = parse_arp(ip_of(frame));
  ASSERT_TRUE(packet);
  EXPECT_EQ(packet->operation, ArpOperation::kReply);
  EXPECT_EQ(packet->sender_mac, kPeerMac);
  EXPECT_EQ(packet->sender_address, kConfig.peer);
  EXPECT_EQ(packet->target_mac, kConfig.mac);
  EXPECT_EQ(packet->target_address, kConfig.address);
}

// RFC 826: hardware, protocol, their lengths and the operation are the first 8 bytes.
TEST(Arp, RefusesEverythingButEthernetIpv4RequestsAndReplies) {
  for (std::size_t bit = 0; bit < 64; ++bit) {
    Frame frame = linux_arp_request();
    frame[kIpOffset + bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    EXPECT_FALSE(parse_arp(ip_of(frame))) << bit;
  }
  for (std::size_t size = 0; size < kArpPacketBytes; ++size) {
    EXPECT_FALSE(parse_arp(ip_of(linux_arp_request()).first(size))) << size;
  }
}

TEST(Icmp, KnowsAnEchoRequestByTypeCodeAndChecksum) {
  const Frame frame = linux_ping();
  const auto message = ip_of(frame).subspan(kIpv4HeaderBytes);
  EXPECT_EQ(classify_icmp(message), IcmpStatus::kEchoRequest);
  EXPECT_EQ(classify_icmp(message.first(7)), IcmpStatus::kBad);
  EXPECT_EQ(classify_icmp(message.first(message.size() - 2)), IcmpStatus::kBad) << "checksum";
  EXPECT_EQ(classify_icmp(from_hex("0800f7ff0000")), IcmpStatus::kBad) << "short, sum right";
  // Types and codes with a right checksum: 0000 ffff is an echo reply, 0301 an unreachable host.
  EXPECT_EQ(classify_icmp(from_hex("0000ffff00000000")), IcmpStatus::kOther);
  EXPECT_EQ(classify_icmp(from_hex("0301fcfe00000000")), IcmpStatus::kOther);
  EXPECT_EQ(classify_icmp(from_hex("0801f7fe00000000")), IcmpStatus::kOther) << "code 1";
  EXPECT_EQ(classify_icmp(from_hex("0800f7ff00000000")), IcmpStatus::kEchoRequest);
}

// A ping that the Linux kernel was sent, and what it answered.
TEST(Icmp, RepliesAsLinuxDoes) {
  const Frame request =
      from_hex("08003b2112340007 6162636465666768696a6b6c6d6e6f7071727374757677616263646566676869");
  const Frame expected =
      from_hex("0000432112340007 6162636465666768696a6b6c6d6e6f7071727374757677616263646566676869");
  Frame reply(request.size(), std::byte{0xEE});
  write_echo_reply(reply, request);
  EXPECT_EQ(reply, expected);
}

TEST(Outbound, AsksAndAnswersArpAsLinuxDoes) {
  EXPECT_EQ(built([](FrameBuffer frame) {
              return build_arp_request(frame, kLinux, kLinux.peer, kBroadcastMac);
            }),
            padded(linux_arp_request()));
  const ArpPacket request{.operation = ArpOperation::kRequest,
                          .sender_mac = kConfig.mac,
                          .sender_address = kConfig.address,
                          .target_mac = {},
                          .target_address = kConfig.peer};
  EXPECT_EQ(built([&](FrameBuffer frame) { return build_arp_reply(frame, kLinux, request); }),
            padded(linux_arp_reply()));
}

TEST(Outbound, WrapsMessagesAsLinuxDoes) {
  const Destination to{.mac = kConfig.mac,
                       .address = kLinux.peer,
                       .port = kLinux.peer_port,
                       .source_port = kLinux.source_port};
  const auto message = [&](const Frame& expected, std::uint16_t identification) {
    return built([&](FrameBuffer frame) {
      return build_datagram(frame, kLinux, to, identification,
                            std::span(expected).subspan(kPayloadOffset));
    });
  };
  EXPECT_EQ(message(linux_udp_even(), 0x73E5), padded(linux_udp_even()));
  EXPECT_EQ(message(linux_udp_odd(), 0x7411), padded(linux_udp_odd()));
}

}  // namespace
}  // namespace iog::net::testing
