// A target that offers its service, on a wire: whoever subscribes gets what the peer gets, the peer
// comes first, and a target that offers nothing sends not a byte more.
#include "app/offering.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "app/loop.hpp"
#include "discovery/bytes.hpp"
#include "fake_machine.hpp"
#include "net/frames.hpp"

namespace iog::app {
namespace {

using discovery::testing::scapy_find;
using net::testing::be16;
using net::testing::Frame;
using net::testing::kConfig;
using net::testing::put_be16;
using testing::FakeMachine;

constexpr std::size_t kAlways = 201;  // counters of any target (docs/spec.md 3.7)
constexpr std::size_t kRing = 1408;   // of the board: 1088 and the copies'
constexpr std::size_t kIpOffset = net::testing::kIpOffset;
constexpr std::size_t kUdpOffset = net::testing::kUdpOffset;

net::Config config_of_instance(std::uint8_t instance) {
  net::Config config = kConfig;
  config.service_instance = instance;
  return config;
}

// A datagram of service discovery from 10.0.2.77, without a UDP checksum.
Frame from_subscriber(const Frame& payload) {
  Frame frame = net::testing::linux_udp_even();
  frame.resize(net::testing::kPayloadOffset);
  frame[11] = std::byte{0x4D};
  frame[kIpOffset + 15] = std::byte{77};
  put_be16(frame, kIpOffset + 2, 28 + payload.size());
  net::testing::fix_ip_checksum(frame);
  put_be16(frame, kUdpOffset, 30'490);
  put_be16(frame, kUdpOffset + 2, 30'490);
  put_be16(frame, kUdpOffset + 4, 8 + payload.size());
  put_be16(frame, net::testing::kUdpChecksumOffset, 0);
  std::ranges::copy(payload, std::back_inserter(frame));
  return frame;
}

Frame arp_of_subscriber() {
  Frame answer = net::testing::linux_arp_reply();
  answer[11] = answer[27] = std::byte{0x4D};
  answer[31] = std::byte{77};
  return answer;
}

class Bench {
 public:
  explicit Bench(std::uint8_t instance = 1, bool has_peer = true)
      : platform(machine, config_of_instance(instance)) {
    if (has_peer) {
      take(net::testing::linux_arp_reply());
    }
    pass(1'000'000);
  }

  void take(Frame frame) {
    machine.ethernet().arrive(std::move(frame));
    if (const auto datagram = platform.host().poll(machine.clock().now_us())) {
      is_taken = platform.offering().take(*datagram, machine.clock().now_us());
    }
  }

  void pass(std::uint64_t us) {
    for (const std::uint64_t end_us = machine.clock().time_us + us;
         machine.clock().time_us < end_us;) {
      machine.clock().time_us += 1'000;
      static_cast<void>(platform.host().poll(machine.clock().now_us()));
      platform.offering().tick(machine.clock().now_us());
    }
  }

  void subscribe() {
    take(from_subscriber(discovery::testing::scapy_subscribe()));
    pass(1'000);
    take(arp_of_subscriber());
    pass(1'000);
    machine.ethernet().pump();
    static_cast<void>(machine.ethernet().take_sent());
  }

  // A frame of so many messages; how many the peer and the subscriber get.
  struct Got {
    std::size_t peer = 0;
    std::size_t subscriber = 0;
    bool operator==(const Got&) const = default;
  };
  Got send(std::size_t messages) {
    static_cast<void>(platform.vitals({}));
    Frame message(100);
    for (std::size_t i = 0; i < messages; ++i) {
      put_be16(message, 0, i);
      taken += platform.send_message(message) ? 1U : 0U;
    }
    Got got;
    for (const Frame& frame : machine.ethernet().take_sent()) {
      const unsigned last = std::to_integer<unsigned>(frame[kIpOffset + 19]);
      got.peer += last == 2 ? 1U : 0U;
      got.subscriber += last == 77 ? 1U : 0U;
    }
    return got;
  }

  [[nodiscard]] std::uint32_t count(discovery::Count what) {
    return platform.offering().counts()[static_cast<std::size_t>(what)];
  }

  FakeMachine machine;
  bool is_taken = false;
  std::size_t taken = 0;
  MachinePlatform<FakeMachine> platform;
};

TEST(Offering, ASubscriberGetsWhatThePeerGets) {
  Bench bench;
  EXPECT_EQ(bench.send(3), (Bench::Got{3, 0}));
  bench.subscribe();
  EXPECT_EQ(bench.send(3), (Bench::Got{3, 3}));
  EXPECT_EQ(bench.count(discovery::Count::kCopied), 3U);
  bench.pass(3'000'000);
  static_cast<void>(bench.machine.ethernet().take_sent());
  EXPECT_EQ(bench.send(3), (Bench::Got{3, 0})) << "its time is over";
}

// docs/service_discovery.md, "Whom it believes": what another station says ends no subscription.
TEST(Offering, NoArpThatNobodyHasAskedForEndsASubscription) {
  Frame question = net::testing::linux_arp_request();
  question.at(31) = std::byte{77};
  for (Frame claim : {arp_of_subscriber(), question}) {
    claim.at(11) = claim.at(27) = std::byte{0x66};
    Bench bench;
    bench.subscribe();
    bench.take(claim);
    bench.pass(1'500'000);
    bench.take(arp_of_subscriber());  // it was asked, and answers
    bench.take(claim);
    bench.pass(100'000);
    static_cast<void>(bench.machine.ethernet().take_sent());
    EXPECT_EQ(bench.send(3), (Bench::Got{3, 3}));
    EXPECT_EQ(bench.count(discovery::Count::kSpoofed), 0U);
  }
}

// Where it has gone, and another station has its address, it ends.
TEST(Offering, ASubscriberAtAnotherStationIsNoneAnyMore) {
  Bench bench;
  bench.subscribe();
  Frame moved = arp_of_subscriber();
  moved.at(11) = moved.at(27) = std::byte{0x66};
  bench.take(moved);
  bench.pass(2'200'000);
  EXPECT_EQ(bench.count(discovery::Count::kSpoofed), 0U);
  bench.take(moved);
  bench.pass(1'000);
  EXPECT_EQ(bench.count(discovery::Count::kSpoofed), 1U);
}

std::vector<Frame> datagrams_of(const std::vector<Frame>& frames) {
  std::vector<Frame> datagrams;
  std::ranges::copy_if(frames, std::back_inserter(datagrams),
                       [](const Frame& frame) { return be16(frame, 12) == 0x0800; });
  return datagrams;
}

TEST(Offering, TheCopyHasThePeersBytes) {
  Bench bench;
  bench.subscribe();
  const Frame message(40, std::byte{7});
  ASSERT_TRUE(bench.platform.send_message(message));
  const auto sent = datagrams_of(bench.machine.ethernet().take_sent());
  ASSERT_EQ(sent.size(), 2U);
  for (const Frame& frame : sent) {
    EXPECT_EQ(Frame(frame.begin() + net::testing::kPayloadOffset, frame.end()), message);
    EXPECT_EQ(be16(frame, kUdpOffset), kConfig.source_port);
  }
  EXPECT_EQ(be16(sent[0], kUdpOffset + 2), kConfig.peer_port);
  EXPECT_EQ(be16(sent[1], kUdpOffset + 2), 30'500U);
}

// Copies have 256 buffers, and those 64 that the peer's frame does not need.
TEST(Offering, ThePeerComesFirst) {
  Bench bench;
  bench.subscribe();
  bench.machine.ethernet().set_ring_slots(kRing);
  EXPECT_EQ(bench.send(300), (Bench::Got{300, 300}));
  bench.machine.ethernet().pump();
  EXPECT_EQ(bench.send(1088), (Bench::Got{1088, 320})) << "a whole raw grid";
  EXPECT_EQ(bench.count(discovery::Count::kNotCopied), 768U);
  bench.machine.ethernet().pump();
  bench.machine.ethernet().set_ring_slots(1088);
  EXPECT_EQ(bench.send(1088), (Bench::Got{1088, 0})) << "what was sent before is still in flight";
}

TEST(Offering, ASubscriberIsServedWithoutAPeer) {
  Bench bench(1, false);
  EXPECT_EQ(bench.send(1), (Bench::Got{0, 0}));
  EXPECT_EQ(bench.taken, 0U);
  bench.subscribe();
  EXPECT_EQ(bench.send(3), (Bench::Got{0, 3}));
  EXPECT_EQ(bench.taken, 3U) << "somebody has them";
}

TEST(Offering, ATargetThatOffersNothingSaysNothing) {
  Bench bench(0);
  static_cast<void>(bench.machine.ethernet().take_sent());
  Frame to_us = from_subscriber(scapy_find());
  bench.take(to_us);
  EXPECT_FALSE(bench.is_taken) << "it is one of any stranger's";
  bench.subscribe();
  bench.pass(20'000'000);
  EXPECT_TRUE(datagrams_of(bench.machine.ethernet().take_sent()).empty());
  EXPECT_EQ(bench.send(3), (Bench::Got{3, 0}));
  EXPECT_EQ(bench.platform.vitals({}).link_counter_count, kAlways);
}

// docs/spec.md 3.7: at the end.
TEST(Offering, ItsCountersAreAmongTheLinkCounters) {
  Bench bench;
  bench.take(from_subscriber(scapy_find()));
  EXPECT_TRUE(bench.is_taken);
  const Vitals& vitals = bench.platform.vitals({});
  ASSERT_EQ(vitals.link_counter_count, kAlways + discovery::kCounts);
  EXPECT_EQ(vitals.link_counters[stream::place_of("SD received")], 1U);
  EXPECT_EQ(vitals.link_counters[stream::place_of("SD found")], 1U);
}

// The offer holds for 3 s more than the target lives, unless it says that it ends.
TEST(Offering, IsWithdrawnBeforeARunIsEndedForSilence) {
  Bench bench;
  const health::MemoryCheck check{{}};
  Life life(bench.machine.clock().now_us());
  static_cast<void>(bench.machine.ethernet().take_sent());
  bench.machine.clock().time_us += Life::kWindowUs + 1;
  life.end_pass(bench.machine, bench.platform, check);
  ASSERT_EQ(bench.machine.ends.size(), 1U);
  const auto sent = datagrams_of(bench.machine.ethernet().take_sent());
  ASSERT_EQ(sent.size(), 1U);
  const std::size_t ttl_at = net::testing::kPayloadOffset + discovery::testing::kTtlAt;
  EXPECT_EQ(be16(sent[0], ttl_at - 1), 0x0500U) << "version, time to live";
  EXPECT_EQ(be16(sent[0], ttl_at + 1), 0U);
}

}  // namespace
}  // namespace iog::app
