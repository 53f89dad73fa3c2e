// The server among hosts that find it, subscribe, renew, go and start anew.
#include <gtest/gtest.h>

#include "discovery/server_bench.hpp"

namespace iog::discovery::testing {
namespace {

TEST(Discovery, OffersToTheGroup) {
  const Bench bench;
  EXPECT_EQ(bench.said, scapy_offer());
  EXPECT_EQ(bench.to, (net::Destination{.mac = {{0x01, 0x00, 0x5E, 0x74, 0xE0, 0xF5}},
                                        .address = net::ipv4(224, 244, 224, 245),
                                        .port = 30'490,
                                        .source_port = 30'490}));
  EXPECT_EQ(bench.count(Count::kOffered), 1U);
}

TEST(Discovery, AnswersWhoLooksForItByUnicast) {
  Bench bench;
  for (const auto destination : {kConfig.address, net::kDiscoveryGroup}) {
    bench.destination = destination;
    const unsigned session = destination == kConfig.address ? 1 : 2;
    EXPECT_EQ(bench.ask(scapy_find()), of_session(scapy_offer(), session));
    EXPECT_EQ(bench.to, kBack);
  }
  EXPECT_EQ(bench.count(Count::kFound), 2U);
}

TEST(Discovery, IsFoundByItsVersionsAndNoOthers) {
  constexpr std::size_t kInstanceAt = kEntryAt + 6;
  constexpr std::size_t kMajorAt = kEntryAt + 8;
  constexpr std::size_t kMinorAt = kEntryAt + 12;
  Bench bench;
  Frame exact = scapy_find();
  put_be16(exact, kInstanceAt, 1);
  exact[kMajorAt] = std::byte{5};
  put_be16(exact, kMinorAt, 0);
  put_be16(exact, kMinorAt + 2, 0);
  EXPECT_FALSE(bench.ask(exact).empty());
  EXPECT_TRUE(bench.ask(with(exact, kInstanceAt + 1, 2)).empty());
  EXPECT_TRUE(bench.ask(with(exact, kMajorAt, 3)).empty());
  EXPECT_TRUE(bench.ask(with(exact, kMinorAt + 3, 1)).empty());
  EXPECT_TRUE(bench.ask(with(exact, kEntryAt + 4, 0x4E)).empty()) << "another service";
  EXPECT_TRUE(bench.ask(scapy_offer()).empty()) << "another server";
  EXPECT_EQ(bench.count(Count::kMalformed), 0U);
}

TEST(Discovery, AnswersNobodyBeforeItsFirstOffer) {
  Bench bench;
  bench.server = Server(config_of_instance(1), kService, 0);
  EXPECT_TRUE(bench.ask(scapy_find()).empty());
  EXPECT_TRUE(bench.ask(scapy_subscribe()).empty());
  EXPECT_FALSE(bench.server.neighbour());
}

TEST(Discovery, ASubscriptionIsAcknowledgedWhenArpHasConfirmedItsStation) {
  Bench bench;
  EXPECT_FALSE(bench.server.neighbour());
  EXPECT_TRUE(bench.ask(scapy_subscribe()).empty());
  EXPECT_EQ(bench.server.neighbour(), kSubscriber);
  EXPECT_FALSE(bench.server.subscriber()) << "not a message before";
  bench.answer_arp();
  bench.tick();
  EXPECT_EQ(bench.said, scapy_acknowledgement());
  EXPECT_EQ(bench.to, kBack);
  EXPECT_EQ(bench.server.subscriber(), (net::Destination{.mac = kStation,
                                                         .address = kSubscriber,
                                                         .port = 30'500,
                                                         .source_port = kConfig.source_port}));
  EXPECT_EQ(bench.count(Count::kAcknowledged), 1U);
}

TEST(Discovery, IsRenewedAtOnceAndEndsWithItsTime) {
  Bench bench;
  bench.subscribe();
  for (unsigned renewals = 1; renewals <= 5; ++renewals) {
    bench.advance(2 * kSecondUs);
    ASSERT_TRUE(bench.server.subscriber());
    EXPECT_EQ(bench.next(), of_session(scapy_acknowledgement(), 1 + renewals));
    EXPECT_EQ(bench.count(Count::kAcknowledged), 1 + renewals);
  }
  bench.advance(3 * kSecondUs - 10'000);
  EXPECT_TRUE(bench.server.subscriber());
  bench.advance(10'000);
  EXPECT_FALSE(bench.server.subscriber());
  EXPECT_FALSE(bench.server.neighbour());
  EXPECT_EQ(bench.count(Count::kExpired), 1U);
}

TEST(Discovery, OneWithoutEndEndsWhenItsHostHasLeft) {
  Bench bench;
  Frame forever = scapy_subscribe();
  put_be16(forever, kTtlAt, 0xFFFF);
  forever[kTtlAt + 2] = std::byte{0xFF};
  EXPECT_TRUE(bench.ask(forever).empty());
  bench.answer_arp();
  bench.advance(39 * kSecondUs);
  EXPECT_TRUE(bench.server.subscriber());
  bench.answer_arp();
  bench.advance(39 * kSecondUs);
  EXPECT_TRUE(bench.server.subscriber());
  bench.advance(kSecondUs);
  EXPECT_FALSE(bench.server.subscriber());
  EXPECT_EQ(bench.count(Count::kExpired), 1U);
}

TEST(Discovery, IsStoppedByItsSubscriberAlone) {
  Bench bench;
  bench.subscribe();
  const Frame stop = with(scapy_subscribe(), kTtlAt + 2, 0);
  bench.source = net::ipv4(10, 0, 2, 78);
  bench.station.octets[5] = 0x4E;
  EXPECT_TRUE(bench.next(stop).empty());
  EXPECT_TRUE(bench.server.subscriber());
  bench.source = kSubscriber;
  EXPECT_TRUE(bench.next(stop).empty());
  EXPECT_TRUE(bench.server.subscriber()) << "in its name, from another station";
  EXPECT_EQ(bench.count(Count::kSpoofed), 1U);
  bench.station = kStation;
  EXPECT_TRUE(bench.next(stop).empty());
  EXPECT_FALSE(bench.server.subscriber());
  EXPECT_EQ(bench.count(Count::kStopped), 1U);
}

TEST(Discovery, ASubscriberThatStartsAnewHasToSubscribeAgain) {
  Bench bench;
  bench.subscribe();
  bench.session = 0;
  EXPECT_FALSE(bench.next(scapy_find()).empty());
  EXPECT_FALSE(bench.server.subscriber());
  EXPECT_EQ(bench.count(Count::kRebooted), 1U);
  EXPECT_TRUE(bench.next().empty());
  bench.tick();
  EXPECT_TRUE(bench.server.subscriber()) << "ARP has confirmed it already";
}

// The two ways have counters of their own (PRS, "Session Handling").
TEST(Discovery, ARebootIsLookedForByEachWay) {
  Bench bench;
  bench.subscribe();
  bench.destination = net::kDiscoveryGroup;
  EXPECT_FALSE(bench.ask(of_session(scapy_find(), 1)).empty());
  EXPECT_TRUE(bench.server.subscriber());
  EXPECT_FALSE(bench.ask(of_session(scapy_find(), 1)).empty());
  EXPECT_FALSE(bench.server.subscriber());
}

TEST(Discovery, ThePeerMaySubscribeAndGetsNothingTwice) {
  Bench bench;
  bench.source = kConfig.peer;
  Frame bytes = scapy_subscribe();
  bytes[kAddressAt + 3] = std::byte{2};
  put_be16(bytes, kOptionAt + 10, kConfig.peer_port);
  EXPECT_TRUE(bench.ask(bytes).empty());
  bench.answer_arp();
  bench.tick();
  EXPECT_EQ(bench.said, scapy_acknowledgement());
  EXPECT_FALSE(bench.server.subscriber());
}

TEST(Discovery, AnOfferIsWithdrawn) {
  Bench bench;
  const Outgoing outgoing = bench.server.withdraw();
  Frame expected = of_session(with(scapy_offer(), kTtlAt + 2, 0), 2);
  EXPECT_EQ(Frame(outgoing.view().begin(), outgoing.view().end()), expected);
}

// One offer says it to all of them, and each entry is looked at.
TEST(Discovery, TwoThatLookForItInOneMessageGetOneOffer) {
  Bench bench;
  const Frame find = scapy_find();
  Frame twice = find;
  twice.insert(twice.begin() + kEntryAt, find.begin() + kEntryAt, find.begin() + kEntryAt + 16);
  put_be16(twice, 6, static_cast<std::uint16_t>(twice.size() - 8));  // SOME/IP's length
  put_be16(twice, kEntryAt - 2, 2 * 16);                             // of the entries
  EXPECT_EQ(bench.ask(twice), of_session(scapy_offer(), 1));
  EXPECT_EQ(bench.count(Count::kFound), 1U);
}

TEST(Discovery, FromNoPortOrAGroupIsMalformed) {
  Bench bench;
  bench.station = {{0x01, 0x00, 0x5E, 0x00, 0x00, 0x01}};
  EXPECT_TRUE(bench.ask(scapy_find()).empty());
  bench.station = kStation;
  EXPECT_TRUE(bench.ask_from_port(0, scapy_find()).empty());
  EXPECT_EQ(bench.count(Count::kMalformed), 2U);
  EXPECT_FALSE(bench.ask(scapy_find()).empty());
}

TEST(Discovery, ASubscriptionOfAnotherServiceIsNoneOfOurs) {
  Bench bench;
  EXPECT_TRUE(bench.ask(with(scapy_subscribe(), kEntryAt + 4, 0x4E)).empty());
  EXPECT_FALSE(bench.server.neighbour());
  EXPECT_EQ(bench.count(Count::kRefused), 0U);
}

// Asked again before ARP has answered, it is still one, with the time that was asked for last.
TEST(Discovery, OneThatIsNotConfirmedYetMayAskAgain) {
  Bench bench;
  EXPECT_TRUE(bench.ask(scapy_subscribe()).empty());
  EXPECT_TRUE(bench.next(with(scapy_subscribe(), kTtlAt + 2, 9)).empty());
  EXPECT_EQ(bench.count(Count::kAcknowledged), 0U);
  bench.answer_arp();
  bench.tick();
  EXPECT_EQ(bench.said, with(scapy_acknowledgement(), kTtlAt + 2, 9));
  EXPECT_EQ(bench.count(Count::kAcknowledged), 1U);
}

// The event group and the instance are part of what is stopped (PRS, "StopSubscribeEventgroup").
TEST(Discovery, AStopOfSomethingElseStopsNothing) {
  Bench bench;
  bench.subscribe();
  const Frame stop = with(scapy_subscribe(), kTtlAt + 2, 0);
  EXPECT_TRUE(bench.next(with(stop, kEntryAt + 7, 2)).empty());
  EXPECT_TRUE(bench.server.subscriber()) << "another instance";
  EXPECT_TRUE(bench.next(with(stop, kEntryAt + 15, 2)).empty());
  EXPECT_TRUE(bench.server.subscriber()) << "another event group";
  EXPECT_TRUE(bench.next(stop).empty());
  EXPECT_FALSE(bench.server.subscriber());
}

TEST(Discovery, WithoutAnAnswerOfArpASubscriptionEnds) {
  Bench bench;
  bench.subscribe();
  bench.told.reset();
  bench.tick();
  EXPECT_FALSE(bench.server.subscriber());
  EXPECT_EQ(bench.count(Count::kExpired), 1U);
}

// A candidate that has had its second makes room, also before the next pass of the loop says so.
TEST(Discovery, ACandidateHoldsThePlaceForItsTimeAlone) {
  Bench bench;
  EXPECT_TRUE(bench.ask(scapy_subscribe()).empty());
  bench.source = net::ipv4(10, 0, 2, 78);
  bench.station.octets[5] = 0x4E;
  const Frame of_another = with(scapy_subscribe(), kAddressAt + 3, 78);
  bench.now_us += kConfirmUs - 1;
  EXPECT_EQ(bench.ask(of_another), of_session(refusal(), 1));
  EXPECT_EQ(bench.server.neighbour(), kSubscriber);
  bench.now_us += 1;
  EXPECT_TRUE(bench.ask(of_another).empty());
  EXPECT_EQ(bench.server.neighbour(), bench.source);
}

// PRS, "Reboot Detection": the flag is set until the session id has wrapped from 0xFFFF to 1.
TEST(Discovery, TheRebootFlagGoesWhenItsSessionsHaveWrapped) {
  Bench bench;
  for (unsigned session = 2; session <= 0xFFFF; ++session) {
    ASSERT_EQ(bench.server.withdraw().view()[kFlagsAt], std::byte{0xC0}) << session;
  }
  const Outgoing outgoing = bench.server.withdraw();
  EXPECT_EQ(outgoing.view()[kFlagsAt], std::byte{0x40});
  EXPECT_EQ(outgoing.view()[kSessionAt + 1], std::byte{1});
}

}  // namespace
}  // namespace iog::discovery::testing
