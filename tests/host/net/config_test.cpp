#include "net/config.hpp"

#include <gtest/gtest.h>

#include "net/frames.hpp"

namespace iog::net {
namespace {

using testing::kConfig;

static_assert(ipv4(10, 0, 2, 15).value == 0x0A00020F);
static_assert(ipv4(255, 255, 255, 255) == kLimitedBroadcast);
static_assert(directed_broadcast(ipv4(10, 0, 2, 15), 24) == ipv4(10, 0, 2, 255));
static_assert(directed_broadcast(ipv4(10, 0, 2, 15), 30) == ipv4(10, 0, 2, 15));
static_assert(directed_broadcast(ipv4(10, 1, 2, 3), 8) == ipv4(10, 255, 255, 255));
static_assert(same_subnet(ipv4(10, 0, 2, 1), ipv4(10, 0, 2, 254), 24));
static_assert(!same_subnet(ipv4(10, 0, 2, 1), ipv4(10, 0, 3, 1), 24));
static_assert(same_subnet(ipv4(10, 0, 2, 1), ipv4(10, 0, 3, 1), 23));

TEST(Address, TellsHostAddressesFromOthers) {
  EXPECT_TRUE(is_host_address(ipv4(10, 0, 2, 15)));
  EXPECT_TRUE(is_host_address(ipv4(223, 255, 255, 1)));
  EXPECT_FALSE(is_host_address(ipv4(0, 0, 0, 0)));
  EXPECT_FALSE(is_host_address(ipv4(0, 1, 2, 3)));
  EXPECT_FALSE(is_host_address(ipv4(127, 0, 0, 1)));
  EXPECT_FALSE(is_host_address(ipv4(224, 0, 0, 1)));
  EXPECT_FALSE(is_host_address(ipv4(240, 0, 0, 1)));
  EXPECT_FALSE(is_host_address(kLimitedBroadcast));
}

TEST(Address, TellsStationsFromGroups) {
  EXPECT_TRUE((MacAddress{{0x52, 0x54, 0, 0x12, 0x34, 0x56}}).is_unicast());
  EXPECT_FALSE((MacAddress{{0x01, 0, 0x5E, 0, 0, 1}}).is_unicast());
  EXPECT_FALSE(kBroadcastMac.is_unicast());
  EXPECT_FALSE(MacAddress{}.is_unicast());
}

template <typename Change>
bool is_valid_after(Change change) {
  Config config = kConfig;
  change(config);
  return is_valid(config);
}

TEST(Config, AcceptsOnlyAStationWithAPeerOnItsSubnet) {
  EXPECT_TRUE(is_valid(kConfig));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.mac = {}; }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.mac = kBroadcastMac; }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.mac.octets[0] = 0x03; }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.address = {}; }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.address = ipv4(10, 0, 2, 0); }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.address = ipv4(10, 0, 2, 255); }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.address = ipv4(127, 0, 0, 1); }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.peer = c.address; }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.peer = ipv4(10, 0, 3, 2); }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.peer = ipv4(10, 0, 2, 255); }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.peer = kLimitedBroadcast; }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.peer_port = 0; }));
  EXPECT_FALSE(is_valid_after([](Config& c) { c.source_port = 0; }));
}

TEST(Config, AcceptsPrefixesThatLeaveRoomForTwoHosts) {
  for (unsigned bits = 0; bits <= 255; ++bits) {
    const bool valid = is_valid_after([&](Config& c) {
      c.prefix_bits = static_cast<std::uint8_t>(bits);
      c.address = ipv4(10, 0, 2, 1);
    });
    EXPECT_EQ(valid, bits >= 8 && bits <= 30) << bits;
  }
}

}  // namespace
}  // namespace iog::net
