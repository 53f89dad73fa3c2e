// Datagrams between a sender and the thread that receives them, on this PC.
#include "tools/receive/udp_receiver.hpp"

#include <arpa/inet.h>
#include <chrono>
#include <cstddef>
#include <sys/socket.h>
#include <thread>
#include <unistd.h>
#include <vector>

#include "gtest/gtest.h"

#include "tools/program/exit_status.hpp"
#include "tools/program/time_of_day.hpp"
#include "tools/replay/udp_sender.hpp"

namespace iog::tools {
namespace {

// Returns a port that nobody uses now. Other tests run beside this one.
std::uint16_t free_port() {
  const int probe = socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in here{};
  here.sin_family = AF_INET;
  here.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  socklen_t size = sizeof here;
  EXPECT_EQ(bind(probe, reinterpret_cast<const sockaddr*>(&here), size), 0);
  EXPECT_EQ(getsockname(probe, reinterpret_cast<sockaddr*>(&here), &size), 0);
  close(probe);
  return ntohs(here.sin_port);
}

std::vector<std::byte> bytes(int number) {
  return std::vector<std::byte>(100, static_cast<std::byte>(number));
}

TEST(UdpReceiver, MessagesHaveTheTimeOfTheirArrivalAndNotOfTheirTaking) {
  const std::uint16_t port = free_port();
  UdpReceiver receiver("127.0.0.1", port);
  UdpSender sender("127.0.0.1", {port});
  const std::uint64_t begin_us = time_of_day_us();
  for (int number = 0; number < 2; ++number) {
    ASSERT_TRUE(sender.send(0, bytes(number)));
    std::this_thread::sleep_for(std::chrono::milliseconds(300));
  }
  const UdpReceiver::Messages messages = receiver.take(std::chrono::milliseconds(0));
  ASSERT_EQ(messages.size(), 2U);
  EXPECT_GE(messages[0].time_us, begin_us);
  EXPECT_GE(messages[1].time_us, messages[0].time_us + 150'000);  // the PC may be busy
}

TEST(UdpReceiver, WhatHasArrivedIsThereAfterTheStop) {
  const std::uint16_t port = free_port();
  UdpReceiver receiver("127.0.0.1", port);
  UdpSender sender("127.0.0.1", {port});
  for (int number = 0; number < 200; ++number) {
    ASSERT_TRUE(sender.send(0, bytes(number)));
  }
  receiver.stop();
  ASSERT_TRUE(sender.send(0, bytes(200)));
  const UdpReceiver::Messages messages = receiver.take(std::chrono::milliseconds(0));
  ASSERT_EQ(messages.size(), 200U);
  for (std::size_t i = 0; i < messages.size(); ++i) {
    EXPECT_EQ(messages[i].bytes, bytes(static_cast<int>(i)));
  }
  EXPECT_TRUE(receiver.take(std::chrono::milliseconds(0)).empty());
}

TEST(UdpSender, SaysWhyNothingCouldBeSent) {
  UdpSender sender("255.255.255.255", {free_port()});  // broadcast, which a socket has to ask for
  EXPECT_NO_THROW(sender.demand_sent()) << "nothing was to be sent";
  EXPECT_FALSE(sender.send(0, bytes(0)));
  EXPECT_THROW(sender.demand_sent(), CheckFailed);
}

TEST(UdpSender, OneDatagramIsEnough) {
  UdpSender sender("127.0.0.1", {free_port()});
  EXPECT_FALSE(sender.send(0, std::vector<std::byte>(70'000))) << "longer than UDP allows";
  EXPECT_THROW(sender.demand_sent(), CheckFailed);
  EXPECT_TRUE(sender.send(0, bytes(0)));
  EXPECT_NO_THROW(sender.demand_sent());
}

}  // namespace
}  // namespace iog::tools
