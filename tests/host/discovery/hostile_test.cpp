// The server among hosts that lie, crowd and flood.
#include <gtest/gtest.h>

#include "discovery/server_bench.hpp"

namespace iog::discovery::testing {
namespace {

// What the endpoint may be: the very host that asks.
TEST(HostileDiscovery, ForAnotherEndpointIsRefused) {
  Bench bench;
  const Frame good = scapy_subscribe();
  const auto is_refused = [&](const Frame& bytes, const Frame& answer = refusal()) {
    const std::uint32_t before = bench.count(Count::kRefused);
    bench.now_us += kSecondUs;
    Frame said = bench.ask(bytes);
    if (said.empty() || bench.count(Count::kRefused) != before + 1 || bench.server.neighbour()) {
      return false;
    }
    return of_session(said, 1) == answer;
  };
  const auto to = [&](std::uint32_t address) {
    Frame bytes = good;
    put_be16(bytes, kAddressAt, address >> 16);
    put_be16(bytes, kAddressAt + 2, address & 0xFFFF);
    return bytes;
  };
  EXPECT_TRUE(is_refused(to(0x0A00'024E))) << "another host";
  EXPECT_TRUE(is_refused(to(0x0A00'0202))) << "the peer";
  EXPECT_TRUE(is_refused(to(0x0A00'020F))) << "us";
  EXPECT_TRUE(is_refused(to(0x0A00'02FF))) << "broadcast";
  EXPECT_TRUE(is_refused(to(0xFFFF'FFFF)));
  EXPECT_TRUE(is_refused(to(0xE0F4'E0F5))) << "a group";
  EXPECT_TRUE(is_refused(to(0x0808'0808))) << "outside of the subnet";
  EXPECT_TRUE(is_refused(to(0)));
  Frame no_port = good;
  put_be16(no_port, kOptionAt + 10, 0);
  EXPECT_TRUE(is_refused(no_port));
  EXPECT_TRUE(is_refused(with(good, kOptionAt + 9, 6))) << "TCP";
  EXPECT_TRUE(is_refused(with(good, kEntryAt + 3, 0))) << "no endpoint";
  EXPECT_TRUE(is_refused(with(good, kEntryAt + 7, 2),
                         refusal(with(scapy_acknowledgement(), kEntryAt + 7, 2))))
      << "another instance";
  EXPECT_TRUE(is_refused(with(good, kEntryAt + 8, 3),
                         refusal(with(scapy_acknowledgement(), kEntryAt + 8, 3))))
      << "another version";
  EXPECT_TRUE(is_refused(with(good, kEntryAt + 15, 2),
                         refusal(with(scapy_acknowledgement(), kEntryAt + 15, 2))))
      << "another event group";
}

TEST(HostileDiscovery, FromOutsideOfTheSubnetOrInFragmentsIsDropped) {
  Bench bench;
  for (const auto source :
       {net::ipv4(8, 8, 8, 8), net::ipv4(10, 0, 3, 77), net::ipv4(10, 0, 2, 0)}) {
    bench.source = source;
    EXPECT_TRUE(bench.ask(scapy_find()).empty());
  }
  bench.source = kSubscriber;
  bench.station = {};
  EXPECT_TRUE(bench.ask(scapy_find()).empty());
  EXPECT_TRUE(bench.ask(Frame(28)).empty());
  EXPECT_EQ(bench.count(Count::kMalformed), 5U);
}

TEST(HostileDiscovery, ToTheGroupIsNoSubscription) {
  Bench bench;
  bench.destination = net::kDiscoveryGroup;
  EXPECT_TRUE(bench.ask(scapy_subscribe()).empty());
  EXPECT_FALSE(bench.server.neighbour());
  EXPECT_EQ(bench.count(Count::kRefused), 1U);
}

TEST(HostileDiscovery, ThereIsRoomForOne) {
  Bench bench;
  bench.subscribe();
  bench.source = net::ipv4(10, 0, 2, 78);
  bench.station.octets[5] = 0x4E;
  const Frame other = with(scapy_subscribe(), kAddressAt + 3, 78);
  EXPECT_EQ(bench.ask(other), of_session(refusal(), 2));
  EXPECT_EQ(bench.server.subscriber()->address, kSubscriber);
  bench.advance(3 * kSecondUs);
  EXPECT_TRUE(bench.ask(other).empty());
  bench.told = net::Told{.mac = bench.station, .at_us = bench.now_us};
  bench.tick();
  EXPECT_EQ(bench.server.subscriber()->address, bench.source);
}

// Whoever takes another's address is asked for by ARP, and another station answers.
TEST(HostileDiscovery, AStationThatArpDoesNotNameGetsNothing) {
  Bench bench;
  bench.station.octets[5] = 0x66;
  EXPECT_TRUE(bench.ask(scapy_subscribe()).empty());
  bench.said.clear();
  bench.answer_arp();
  bench.tick();
  EXPECT_TRUE(bench.said.empty());
  EXPECT_FALSE(bench.server.subscriber());
  EXPECT_EQ(bench.count(Count::kSpoofed), 1U);
  bench.station = kStation;
  bench.subscribe();
  bench.told->mac.octets[5] = 0x66;  // somebody claims the address afterwards
  bench.tick();
  EXPECT_FALSE(bench.server.subscriber());
  EXPECT_EQ(bench.count(Count::kSpoofed), 2U);
}

TEST(HostileDiscovery, ACandidateThatArpDoesNotFindIsForgotten) {
  Bench bench;
  EXPECT_TRUE(bench.ask(scapy_subscribe()).empty());
  bench.advance(kConfirmUs - 10'000);
  EXPECT_TRUE(bench.server.neighbour());
  bench.advance(10'000);
  EXPECT_FALSE(bench.server.neighbour());
  EXPECT_EQ(bench.count(Count::kUnconfirmed), 1U);
}

TEST(HostileDiscovery, AFloodIsNotAnsweredAndDoesNotEndASubscription) {
  Bench bench;
  bench.subscribe();
  unsigned answers = 0;
  for (unsigned i = 0; i < 100'000; ++i) {
    bench.source = {0x0A00'0200 + 100 + i % 100};
    bench.station.octets[4] = static_cast<std::uint8_t>(i);
    answers += bench.ask(i % 2 == 0 ? scapy_find() : scapy_subscribe()).empty() ? 0U : 1U;
    if (i % 1'000 == 0) {
      bench.advance(100'000);
    }
    if (i % 20'000 == 0) {
      bench.source = kSubscriber;
      bench.station = kStation;
      ASSERT_FALSE(bench.next().empty()) << "it renews all the same";
    }
  }
  EXPECT_LE(answers, 8U + 100U);
  EXPECT_GE(bench.count(Count::kFlooded), 99'000U);
  EXPECT_TRUE(bench.server.subscriber());
}

TEST(HostileDiscovery, ManySubscriptionsInOneDatagramAreBounded) {
  Bench bench;
  bench.subscribe();
  Frame many = scapy_subscribe();
  const Frame entry(many.begin() + kEntryAt, many.begin() + kEntryAt + 16);
  for (int i = 1; i < 80; ++i) {
    many.insert(many.begin() + kEntryAt, entry.begin(), entry.end());
  }
  put_be16(many, 6, many.size() - 8);
  put_be16(many, kEntriesAt + 2, 80 * 16);
  const Frame answer = bench.next(many);
  const auto message = read_message(answer);
  ASSERT_TRUE(message);
  EXPECT_EQ(message->entry_count(), kMaxSubscriptionsPerMessage);
  EXPECT_EQ(bench.count(Count::kRefused), 76U);
}

}  // namespace
}  // namespace iog::discovery::testing
