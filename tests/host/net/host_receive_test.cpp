// What Host::poll() delivers, and under which cause it drops the rest.
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <optional>
#include <utility>

#include "net/frames.hpp"
#include "net/host.hpp"
#include "net/station.hpp"

namespace iog::net::testing {
namespace {

// The one cause under which a single frame is dropped; nothing if it is not, or under several.
std::optional<Drop> drop_of(Frame frame) {
  Station station;
  if (station.take(std::move(frame)) || !station.conserved() || station.all_dropped() != 1) {
    return std::nullopt;
  }
  for (std::size_t cause = 0; cause < kDropCauses; ++cause) {
    if (station.host.counters().drops[cause] == 1) {
      return static_cast<Drop>(cause);
    }
  }
  return std::nullopt;
}

Frame with_ip_field(Frame frame, std::size_t offset, unsigned value) {
  put_be16(frame, offset, value);
  fix_ip_checksum(frame);
  return frame;
}

Frame with_source(Ipv4Address source) {
  Frame frame = linux_udp_even();
  put_be16(frame, kUdpChecksumOffset, 0);
  put_be16(frame, kIpOffset + 12, source.value >> 16);
  return with_ip_field(std::move(frame), kIpOffset + 14, source.value & 0xFFFF);
}

Frame with_destination(Ipv4Address destination) {
  Frame frame = linux_udp_even();
  put_be16(frame, kUdpChecksumOffset, 0);
  put_be16(frame, kIpOffset + 16, destination.value >> 16);
  return with_ip_field(std::move(frame), kIpOffset + 18, destination.value & 0xFFFF);
}

TEST(HostReceive, DeliversWhatIsSentToUs) {
  Station station;
  const auto datagram = station.take(linux_udp_odd());
  ASSERT_TRUE(datagram);
  EXPECT_EQ(datagram->source, ipv4(10, 0, 2, 2));
  EXPECT_EQ(datagram->source_port, 19000);
  EXPECT_EQ(datagram->destination_port, 7000);
  EXPECT_EQ(text_of(datagram->payload), "occupancy grid!");
  EXPECT_TRUE(station.conserved());
}

// A Velodyne lidar sends to 255.255.255.255, here even from another subnet, without a checksum.
TEST(HostReceive, DeliversBroadcasts) {
  Station station;
  const auto lidar = station.take(velodyne_broadcast());
  ASSERT_TRUE(lidar);
  EXPECT_EQ(lidar->destination_port, 2368);
  EXPECT_EQ(lidar->payload.size(), 1206U);
  const auto subnet = station.take(linux_udp_subnet_broadcast());
  ASSERT_TRUE(subnet);
  EXPECT_EQ(text_of(subnet->payload), "x");
}

TEST(HostReceive, DeliversInOrderOnePerPollAndReleasesAtTheNext) {
  Station station;
  station.port.arrive(linux_udp_even());
  station.port.arrive(linux_udp_odd());
  const auto first = station.poll();
  ASSERT_TRUE(first);
  EXPECT_EQ(text_of(first->payload), "iogrid");
  EXPECT_EQ(station.port.waiting(), 2U) << "the first frame is held for its reader";
  const auto second = station.poll();
  ASSERT_TRUE(second);
  EXPECT_EQ(text_of(second->payload), "occupancy grid!");
  EXPECT_EQ(station.port.waiting(), 1U);
  EXPECT_FALSE(station.poll());
  EXPECT_EQ(station.port.waiting(), 0U);
  EXPECT_FALSE(station.poll());
  EXPECT_TRUE(station.conserved());
}

Frame not_udp() { return with_ip_field(linux_udp_even(), kIpOffset + 8, 0x4006); }

TEST(HostReceive, LooksAtABoundedNumberOfFramesPerPoll) {
  Station station;
  for (int i = 0; i < kMaxFramesPerPoll; ++i) {
    station.port.arrive(not_udp());
  }
  station.port.arrive(linux_udp_even());
  EXPECT_FALSE(station.poll());
  EXPECT_EQ(station.dropped(Drop::kNotUdpOrIcmp), static_cast<std::uint32_t>(kMaxFramesPerPoll));
  EXPECT_TRUE(station.poll());
  EXPECT_TRUE(station.conserved());
}

TEST(HostReceive, DropsForeignFrames) {
  Frame foreign = linux_udp_even();
  foreign[5] = std::byte{0x10};
  EXPECT_EQ(drop_of(foreign), Drop::kNotForUsMac);
  Frame multicast = linux_udp_even();
  multicast[0] = std::byte{0x01};
  EXPECT_EQ(drop_of(multicast), Drop::kNotForUsMac);
  Frame ipv6 = linux_udp_even();
  put_be16(ipv6, 12, 0x86DD);
  EXPECT_EQ(drop_of(ipv6), Drop::kNotIpv4OrArp);
  Frame vlan = linux_udp_even();
  const Frame tag = from_hex("81000064");
  vlan.insert(vlan.begin() + 12, tag.begin(), tag.end());
  EXPECT_EQ(drop_of(vlan), Drop::kVlanTagged);
  put_be16(vlan, 12, 0x88A8);
  EXPECT_EQ(drop_of(vlan), Drop::kVlanTagged);
  EXPECT_EQ(drop_of(from_hex("02000000000f02000000000208")), Drop::kShort);
}

TEST(HostReceive, DropsBadPackets) {
  EXPECT_EQ(drop_of(with_ip_field(linux_udp_even(), kIpOffset, 0x6500)), Drop::kBadIpHeader);
  Frame checksum = linux_udp_even();
  put_be16(checksum, kIpChecksumOffset, 0xAED4);
  EXPECT_EQ(drop_of(checksum), Drop::kBadIpChecksum);
  EXPECT_EQ(drop_of(not_udp()), Drop::kNotUdpOrIcmp);
  Frame length = linux_udp_even();
  put_be16(length, kUdpOffset + 4, 15);
  EXPECT_EQ(drop_of(length), Drop::kBadUdpLength);
  Frame payload = linux_udp_even();
  payload.back() = std::byte{'D'};
  EXPECT_EQ(drop_of(payload), Drop::kBadUdpChecksum);
  Frame ping = linux_ping();
  ping.back() = std::byte{'!'};
  EXPECT_EQ(drop_of(ping), Drop::kBadIcmp);
}

TEST(HostReceive, DropsWhatIsForAnotherHost) {
  EXPECT_TRUE(Station{}.take(with_destination(ipv4(10, 0, 2, 15))));
  EXPECT_TRUE(Station{}.take(with_destination(ipv4(10, 0, 2, 255))));
  EXPECT_TRUE(Station{}.take(with_destination(kLimitedBroadcast)));
  EXPECT_EQ(drop_of(with_destination(ipv4(10, 0, 2, 16))), Drop::kNotForUsIp);
  EXPECT_EQ(drop_of(with_destination(ipv4(10, 0, 3, 255))), Drop::kNotForUsIp);
  EXPECT_EQ(drop_of(with_destination(ipv4(10, 0, 2, 0))), Drop::kNotForUsIp);
  EXPECT_EQ(drop_of(with_destination(ipv4(224, 0, 0, 1))), Drop::kNotForUsIp);
}

// RFC 1122, section 3.2.1.3: addresses that must not be a source.
TEST(HostReceive, DropsImpossibleSources) {
  EXPECT_TRUE(Station{}.take(with_source(ipv4(10, 0, 2, 16))));
  EXPECT_TRUE(Station{}.take(with_source(ipv4(192, 168, 1, 200))));
  EXPECT_EQ(drop_of(with_source(ipv4(0, 0, 0, 0))), Drop::kBadSource);
  EXPECT_EQ(drop_of(with_source(ipv4(127, 0, 0, 1))), Drop::kBadSource);
  EXPECT_EQ(drop_of(with_source(ipv4(239, 0, 0, 1))), Drop::kBadSource);
  EXPECT_EQ(drop_of(with_source(ipv4(10, 0, 2, 255))), Drop::kBadSource);
  EXPECT_EQ(drop_of(with_source(kLimitedBroadcast)), Drop::kBadSource);
  EXPECT_EQ(drop_of(with_source(ipv4(10, 0, 2, 15))), Drop::kBadSource) << "our own";
}

}  // namespace
}  // namespace iog::net::testing
