// A server of service discovery on a series of datagrams, from four hosts, each of two stations.
// The flag in front of a datagram says from whom it is, by which way, whether ARP answers, and
// whether the lengths of SOME/IP are put right, which the fuzzer would not find by itself.
#include <algorithm>
#include <vector>

#include "discovery/bytes.hpp"
#include "discovery/server.hpp"
#include "law.hpp"
#include "wire/byte_order.hpp"

namespace iog::fuzz {
namespace {

using discovery::testing::kConfig;

constexpr std::size_t kMaxDatagramBytes = 1472;

net::Config offering() {
  net::Config config = kConfig;
  config.service_instance = 1;
  return config;
}

void repair(std::vector<std::byte>& bytes) {
  const auto head = discovery::testing::scapy_find();
  if (bytes.size() >= protection::kSomeIpHeaderBytes) {
    std::copy(head.begin(), head.begin() + 4, bytes.begin());
    std::copy(head.begin() + 12, head.begin() + 16, bytes.begin() + 12);
    wire::store_be32(std::span(bytes).subspan<4, 4>(),
                     static_cast<std::uint32_t>(bytes.size() - 8));
  }
}

net::Datagram datagram_of(std::uint8_t flags, std::span<const std::byte> payload) {
  const std::uint8_t host = flags & 3U;
  return {.source = net::ipv4(10, 0, 2, static_cast<std::uint8_t>(76 + host)),
          .destination = (flags & 8U) != 0 ? net::kDiscoveryGroup : kConfig.address,
          .source_port = net::kDiscoveryPort,
          .destination_port = net::kDiscoveryPort,
          .payload = payload,
          .station = {{0x02, 0, 0, 0, static_cast<std::uint8_t>((flags & 4U) != 0 ? 1 : 0),
                       static_cast<std::uint8_t>(76 + host)}}};
}

// ARP's truth: of each host its first station.
net::MacAddress station_of(net::Ipv4Address host) {
  return {{0x02, 0, 0, 0, 0, static_cast<std::uint8_t>(host.value)}};
}

void look_at(const std::optional<discovery::Outgoing>& outgoing) {
  if (outgoing) {
    const auto message = discovery::read_message(outgoing->view());
    law(message && message->entry_count() > 0, "what is said can be read");
    law(outgoing->to.source_port == net::kDiscoveryPort, "it comes from the port of discovery");
  }
}

void look_at(const discovery::Server& server) {
  if (const auto subscriber = server.subscriber()) {
    law(server.neighbour() == subscriber->address, "a subscriber is looked after");
    law(subscriber->mac == station_of(subscriber->address), "it is where ARP says");
    law(subscriber->address.value - net::ipv4(10, 0, 2, 76).value < 4, "it is one who has asked");
    law(subscriber->port != 0, "it has a port");
  }
}

}  // namespace

void check(std::span<const std::byte> input) {
  wire::ByteReader in(input);
  discovery::Server server(offering(),
                           {.service = 0x4F47, .major = 5, .minor = 0, .event_group = 1}, 0);
  std::uint64_t now_us = 0;
  look_at(server.tick(now_us, std::nullopt));
  now_us += discovery::kInitialDelayMaxUs;
  look_at(server.tick(now_us, std::nullopt));
  while (in.remaining() > 0) {
    const std::uint8_t flags = in.u8();
    const auto piece = next_piece(in);
    std::vector<std::byte> bytes(piece.begin(), piece.end());
    bytes.resize(std::min(bytes.size(), kMaxDatagramBytes));
    if ((flags & 16U) != 0) {
      repair(bytes);
    }
    look_at(server.receive(datagram_of(flags, bytes), now_us));
    look_at(server);
    now_us += std::uint64_t{flags} * 2'000;
    const auto asked = server.neighbour();
    look_at(server.tick(now_us, asked && (flags & 32U) == 0
                                    ? std::optional(net::Told{station_of(*asked), now_us})
                                    : std::nullopt));
    look_at(server);
  }
}

}  // namespace iog::fuzz
