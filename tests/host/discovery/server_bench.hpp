// A server, a clock, ARP, and a host that talks to it.
#pragma once

#include <cstdint>
#include <gtest/gtest.h>
#include <optional>

#include "discovery/bytes.hpp"
#include "discovery/server.hpp"

namespace iog::discovery::testing {
using net::testing::put_be16;

inline constexpr std::uint64_t kSecondUs = 1'000'000;
inline constexpr Service kService{.service = 0x4F47, .major = 5, .minor = 0, .event_group = 1};

inline net::Config config_of_instance(std::uint8_t instance) {
  net::Config config = kConfig;
  config.service_instance = instance;
  return config;
}

class Bench {
 public:
  // Past the initial wait: one offer has been sent.
  Bench() {
    tick();
    advance(kInitialDelayMaxUs);
  }

  void tick() { say(server.tick(now_us, told)); }
  void advance(std::uint64_t by_us) {
    for (const std::uint64_t end_us = now_us + by_us; now_us < end_us;) {
      now_us += 10'000;
      tick();
    }
  }

  // What it is answered with at once, empty without an answer.
  Frame ask(const Frame& payload) { return ask_from_port(30'490, payload); }
  Frame ask_from_port(std::uint16_t port, const Frame& payload) {
    said.clear();
    say(server.receive({.source = source,
                        .destination = destination,
                        .source_port = port,
                        .destination_port = 30'490,
                        .payload = payload,
                        .station = station},
                       now_us));
    return said;
  }

  // A subscription that is confirmed.
  void subscribe() {
    EXPECT_TRUE(ask(scapy_subscribe()).empty()) << "nobody has asked ARP yet";
    answer_arp();
    tick();
    EXPECT_TRUE(server.subscriber());
  }
  void answer_arp() { told = net::Told{.mac = kStation, .at_us = now_us}; }

  // The next message of a subscriber: with the next session id, by default to renew.
  Frame next(Frame payload = scapy_subscribe()) {
    put_be16(payload, kSessionAt, ++session);
    return ask(payload);
  }

  [[nodiscard]] std::uint32_t count(Count what) const {
    return server.counts()[static_cast<std::size_t>(what)];
  }

  std::uint64_t now_us = 7'000'000;
  std::optional<net::Told> told;
  net::Ipv4Address source = kSubscriber;
  net::Ipv4Address destination = kConfig.address;
  net::MacAddress station = kStation;
  unsigned session = 2;
  Frame said;  // the newest message
  net::Destination to;
  Server server{config_of_instance(1), kService, 0};

 private:
  void say(const std::optional<Outgoing>& outgoing) {
    if (outgoing) {
      said.assign(outgoing->view().begin(), outgoing->view().end());
      to = outgoing->to;
    }
  }
};

inline constexpr net::Destination kBack{
    .mac = kStation, .address = kSubscriber, .port = 30'490, .source_port = 30'490};

inline Frame refusal(Frame acknowledgement = scapy_acknowledgement()) {
  acknowledgement[kTtlAt + 2] = std::byte{0};
  return acknowledgement;
}

// With a session and, once it is known, the rest as scapy makes it.
inline Frame of_session(Frame message, unsigned session) {
  put_be16(message, kSessionAt, session);
  return message;
}

inline Frame with(Frame bytes, std::size_t at, unsigned value) {
  bytes.at(at) = static_cast<std::byte>(value);
  return bytes;
}

}  // namespace iog::discovery::testing
