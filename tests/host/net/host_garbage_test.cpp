// The wire is hostile. Whatever arrives, poll() survives it, every frame is counted exactly once,
// and a frame that is not intact is not delivered.
#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <gtest/gtest.h>
#include <random>
#include <utility>
#include <vector>

#include "net/frames.hpp"
#include "net/host.hpp"
#include "net/station.hpp"

namespace iog::net::testing {
namespace {

// One frame of every kind that has a path of its own through the host.
std::vector<Frame> good_frames() {
  Frame vlan = linux_udp_even();
  const Frame tag = from_hex("81000064");
  vlan.insert(vlan.begin() + 12, tag.begin(), tag.end());
  Frame conflict = linux_arp_request();
  put_be16(conflict, 30, 0x020F);  // the sender is our address
  return {linux_udp_even(),
          linux_udp_odd(),
          linux_udp_subnet_broadcast(),
          linux_arp_request(),
          linux_arp_reply(),
          linux_ping(),
          linux_ping_reply(),
          velodyne_broadcast(),
          linux_last_fragment(),
          vlan,
          conflict};
}

std::uint32_t answers(const Counters& counters) {
  return counters.arp_answered + counters.arp_learned + counters.ping_answered;
}

TEST(HostGarbage, TruncatedFramesAreDroppedAtEveryLength) {
  for (const Frame& whole : good_frames()) {
    Station station;
    station.resolve();
    const std::uint32_t before = answers(station.host.counters());
    for (std::size_t size = 1; size < whole.size(); ++size) {
      const Frame cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
      ASSERT_FALSE(station.take(cut)) << size;
      ASSERT_TRUE(station.conserved()) << size;
    }
    EXPECT_EQ(station.all_dropped(), whole.size() - 1);
    EXPECT_EQ(answers(station.host.counters()), before);
    EXPECT_EQ(station.dropped(Drop::kShort), 13U);
  }
}

// Both checksums cover every bit behind the Ethernet header, and the header's destination and type
// are compared: only the frame's source address may be changed unnoticed.
TEST(HostGarbage, OneWrongBitIsNoticedEverywhereButInTheSourceAddress) {
  for (const Frame& right : {linux_udp_even(), linux_udp_odd()}) {
    for (std::size_t bit = 0; bit < right.size() * 8; ++bit) {
      Station station;
      Frame wrong = right;
      wrong[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
      const bool in_source = bit / 8 >= 6 && bit / 8 < 12;
      ASSERT_EQ(station.take(wrong).has_value(), in_source) << bit;
      ASSERT_EQ(station.all_dropped(), in_source ? 0U : 1U) << bit;
      ASSERT_TRUE(station.conserved()) << bit;
    }
  }
}

TEST(HostGarbage, OneWrongBitInAnyFrameIsCountedOnce) {
  for (const Frame& right : good_frames()) {
    const std::size_t bits = std::min<std::size_t>(right.size(), 74) * 8;
    for (std::size_t bit = 0; bit < bits; ++bit) {
      Station station;
      Frame wrong = right;
      wrong[bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
      static_cast<void>(station.take(wrong));
      ASSERT_TRUE(station.conserved()) << bit;
      ASSERT_EQ(station.host.counters().received, 1U);
    }
  }
}

// Pure noise passes the MAC filter once in 2^47 frames, so half of it is given our address.
TEST(HostGarbage, NoiseIsCounted) {
  std::mt19937 random{791};
  Station station;
  constexpr std::uint32_t kFrames = 100'000;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    Frame frame(1 + random() % 128);
    for (std::byte& byte : frame) {
      byte = static_cast<std::byte>(random());
    }
    for (std::size_t k = 0; k < 6 && k < frame.size() && i % 2 == 0; ++k) {
      frame[k] = static_cast<std::byte>(kConfig.mac.octets[k]);
    }
    static_cast<void>(station.take(std::move(frame), i));
    station.port.pump();
  }
  EXPECT_TRUE(station.conserved());
  EXPECT_EQ(station.host.counters().received, kFrames);
  EXPECT_EQ(station.host.counters().delivered, 0U);
}

// Good frames, wounded: some bytes set at random, the length changed, and then the IPv4 checksum
// made right again half of the time, so that the wounds reach the layers above it.
Frame wounded(std::mt19937& random, const std::vector<Frame>& good) {
  Frame frame = good[random() % good.size()];
  for (unsigned wounds = random() % 4; wounds > 0; --wounds) {
    frame[random() % std::min<std::size_t>(frame.size(), 50)] = static_cast<std::byte>(random());
  }
  if (random() % 4 == 0) {
    frame.resize(1 + random() % 1514, static_cast<std::byte>(random()));
  }
  if (random() % 2 == 0 && frame.size() >= kUdpOffset) {
    fix_ip_checksum(frame);
  }
  return frame;
}

TEST(HostGarbage, WoundedFramesAreCountedAndReachEveryCause) {
  std::mt19937 random{826};
  const std::vector<Frame> good = good_frames();
  Station station;
  std::uint32_t delivered = 0;
  constexpr std::uint32_t kFrames = 200'000;
  for (std::uint32_t i = 0; i < kFrames; ++i) {
    // The ring is nearly always emptied in time.
    if (random() % 8 != 0) {
      station.port.pump();
    }
    station.port.set_ring_slots(random() % 16);
    const auto datagram = station.take(wounded(random, good), std::uint64_t{i} * 1000);
    if (datagram) {
      ++delivered;
      // Every byte of what is delivered may be read.
      static_cast<void>(reference_checksum(datagram->payload));
    }
    if (random() % 16 == 0) {
      static_cast<void>(station.host.send_message(std::vector<std::byte>(random() % 1500)));
    }
    static_cast<void>(station.port.take_sent());
    ASSERT_TRUE(station.conserved()) << i;
  }
  EXPECT_EQ(station.host.counters().received, kFrames);
  EXPECT_EQ(station.host.counters().delivered, delivered);
  EXPECT_GT(station.host.counters().arp_answered, 0U);
  EXPECT_GT(station.host.counters().arp_learned, 0U);
  EXPECT_GT(station.host.counters().ping_answered, 0U);
  for (std::size_t cause = 0; cause < kDropCauses; ++cause) {
    EXPECT_GT(station.host.counters().drops[cause], 0U) << cause;
  }
}

}  // namespace
}  // namespace iog::net::testing
