// Whose fragments are joined: nobody's whom the car does not listen to (docs/spec.md, 1.5).
#include "app/fragment_senders.hpp"

#include <gtest/gtest.h>
#include <vector>

namespace iog::app {
namespace {

using net::ipv4;

constexpr net::Ipv4Address kPeer = ipv4(10, 0, 2, 2);
constexpr net::Ipv4Address kSomebody = ipv4(10, 0, 2, 66);

vehicle::Vehicle car_with(std::span<const vehicle::Sensor> sensors, net::Ipv4Address poses = {}) {
  vehicle::Vehicle car;
  car.sensors = sensors;
  car.poses.source_ipv4 = poses.value;
  car.maps.source_ipv4 = poses.value;
  return car;
}

TEST(FragmentSenders, AreThoseWhomTheCarListensTo) {
  std::vector<vehicle::Sensor> sensors(8);
  for (std::uint32_t i = 0; i < sensors.size(); ++i) {
    sensors[i].source_ipv4 = ipv4(10, 0, 2, 101).value + i;
  }
  const auto senders = fragment_senders(car_with(sensors, ipv4(10, 0, 2, 50)), kPeer);
  EXPECT_EQ(senders.datagrams_of(ipv4(10, 0, 2, 101)), 1U);
  EXPECT_EQ(senders.datagrams_of(ipv4(10, 0, 2, 108)), 1U);
  EXPECT_EQ(senders.datagrams_of(ipv4(10, 0, 2, 50)), 2U) << "poses and maps";
  EXPECT_EQ(senders.datagrams_of(kPeer), 8U);
  EXPECT_EQ(senders.datagrams_of(kSomebody), 0U);
}

// As their packets are; poses and maps without an address let nobody in.
TEST(FragmentSenders, WithoutAnAddressASensorsAreAnybodys) {
  std::vector<vehicle::Sensor> sensors(5);
  sensors[0].source_ipv4 = ipv4(10, 0, 2, 101).value;
  const auto senders = fragment_senders(car_with(sensors), kPeer);
  EXPECT_EQ(senders.datagrams_of(kSomebody), 4U);
  EXPECT_FALSE(senders.is_listed(kSomebody));
  EXPECT_TRUE(senders.is_listed(ipv4(10, 0, 2, 101)));
  EXPECT_EQ(senders.room_for_others(), 18U - 1 - 5);
  EXPECT_EQ(fragment_senders(car_with(std::span(sensors).first(1)), kPeer).datagrams_of(kSomebody),
            0U);
}

}  // namespace
}  // namespace iog::app
