// The loop on a machine that takes its time: what it cannot do in time is left and counted, and
// nothing piles up.
#include "app/loop.hpp"

#include <algorithm>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "app/refused_car.hpp"
#include "fake_machine.hpp"
#include "fakes/fake_ethernet_port.hpp"
#include "fakes/fake_platform.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/test_vehicles.hpp"
#include "net/frames.hpp"

namespace iog::app {
namespace {

using net::testing::Frame;
using net::testing::kConfig;
using testing::FakeClock;
using testing::FakeMachine;
using tests::LuxMessage;
using tests::ThreeLux;
using vehicle::Fate;

constexpr std::uint64_t kPeriodUs = 40'000;
constexpr int kParts = 8;  // messages of a scan
constexpr std::size_t kPointsPerMessage = 25;
constexpr std::size_t kRingFrames = 256;

using Target = Pipeline<MachinePlatform<FakeMachine>, SerialSink>;

// Takes its time for each datagram, and none to leave one.
struct SlowTarget {
  Target& target;
  FakeClock& clock;
  std::uint64_t datagram_us;

  void take(const intake::Datagram& datagram, std::uint64_t now_us) {
    target.take(datagram, now_us);
    clock.time_us += datagram_us;
  }
  void leave(const intake::Datagram& datagram, std::uint64_t now_us) {
    target.leave(datagram, now_us);
  }
  void tick(std::uint64_t now_us) { target.tick(now_us); }
  [[nodiscard]] std::uint64_t deadline_us() const { return target.deadline_us(); }
};

// A datagram of the peer, who may speak for every sensor; without a UDP checksum.
Frame datagram_to(std::uint16_t port, const std::vector<std::byte>& payload) {
  Frame frame = net::testing::linux_udp_even();
  frame.resize(net::testing::kPayloadOffset);
  net::testing::put_be16(frame, net::testing::kIpOffset + 2, 28 + payload.size());
  net::testing::fix_ip_checksum(frame);
  net::testing::put_be16(frame, net::testing::kUdpOffset + 2, port);
  net::testing::put_be16(frame, net::testing::kUdpOffset + 4, 8 + payload.size());
  net::testing::put_be16(frame, net::testing::kUdpChecksumOffset, 0);
  std::ranges::copy(payload, std::back_inserter(frame));
  return frame;
}

// Three LUX at 25 Hz, each scan in eight messages, evenly over the period: 24 datagrams.
class Traffic {
 public:
  // What has come by now, as far as the ring holds it.
  void arrive(std::uint64_t now_us, fakes::FakeEthernetPort& port) {
    for (; next_us() <= now_us; ++sent_) {
      if (port.waiting() >= kRingFrames) {
        port.overflow();
        continue;
      }
      port.arrive(frame());
    }
  }

  [[nodiscard]] std::uint64_t sent() const { return sent_; }
  [[nodiscard]] std::uint64_t scan() const { return sent_ / (3 * kParts); }

 private:
  [[nodiscard]] std::uint64_t next_us() const {
    return 1'000'000 + sent_ * kPeriodUs / (3 * kParts);
  }

  [[nodiscard]] Frame frame() const {
    const int part = static_cast<int>(sent_ / 3 % kParts);
    const int left = 1600 - 3200 * part / kParts;
    const int right = 1600 - 3200 * (part + 1) / kParts;
    LuxMessage message{.scan_number = static_cast<int>(scan() + 1),
                       .start_ticks = left,
                       .end_ticks = right,
                       .points = {}};
    message.points.assign(kPointsPerMessage, {.angle_ticks = right + 5, .range_cm = 1000});
    return datagram_to(static_cast<std::uint16_t>(100 + sent_ % 3), message.bytes());
  }

  std::uint64_t sent_ = 0;
};

class Bench {
 public:
  explicit Bench(std::uint64_t datagram_us) : slow_{*target_, machine_.clock(), datagram_us} {
    machine_.ethernet().arrive(net::testing::linux_arp_reply());
    target_->start(machine_.clock().now_us());
  }

  void run(std::uint64_t duration_us) {
    const std::uint64_t end_us = machine_.clock().now_us() + duration_us;
    while (machine_.clock().now_us() < end_us) {
      traffic.arrive(machine_.clock().now_us(), machine_.ethernet());
      if (!pass(machine_, platform_, *serial_, backlog_, check_, life_, slow_)) {
        machine_.idle();
      }
      receive();
    }
  }

  // The machine stands still, and its ring fills.
  void stall(std::uint64_t duration_us) { machine_.clock().time_us += duration_us; }

  [[nodiscard]] std::uint64_t points(Fate fate) const {
    std::uint64_t sum = 0;
    for (const tests::ReceivedFrame& frame : receiver.frames) {
      sum += frame.end.fates[static_cast<std::size_t>(fate)];
    }
    return sum;
  }

  [[nodiscard]] std::uint64_t all_points() const {
    std::uint64_t sum = 0;
    for (const tests::ReceivedFrame& frame : receiver.frames) {
      sum += frame.header.points_used + frame.header.points_other;
    }
    return sum;
  }

  // As the newest frame says it: the first after those of the cores (docs/spec.md 3.7).
  [[nodiscard]] std::uint32_t overflows() const {
    return receiver.frames.back().end.link_counters.at(stream::kCoreCounters + 6);
  }

  [[nodiscard]] std::size_t timed_out() const {
    return static_cast<std::size_t>(std::ranges::count_if(receiver.frames, [](const auto& frame) {
      return frame.header.has_evidence() && (frame.header.flags & stream::kFlagTimedOut) != 0;
    }));
  }

  Traffic traffic;
  tests::FakePlatform receiver;
  std::uint64_t oldest_scans = 0;  // of a frame's newest sensor, behind what has come

 private:
  void receive() {
    for (const Frame& frame : machine_.ethernet().take_sent()) {
      if (net::testing::be16(frame, 12) != 0x0800) {
        continue;
      }
      const std::size_t before = receiver.frames.size();
      ASSERT_TRUE(receiver.send_message(std::span(frame).subspan(net::testing::kPayloadOffset)));
      if (receiver.frames.size() > before && receiver.frames.back().header.has_evidence()) {
        note_age(receiver.frames.back());
      }
    }
  }

  void note_age(const tests::ReceivedFrame& frame) {
    std::uint32_t newest = 0;
    for (std::size_t i = 0; i < frame.header.sensor_count; ++i) {
      newest = std::max(newest, frame.end.sensors[i].scan_number);
    }
    oldest_scans = std::max(oldest_scans, traffic.scan() + 1 - newest);
  }

  FakeMachine machine_;
  MachinePlatform<FakeMachine> platform_{machine_, kConfig};
  std::unique_ptr<SerialSink> serial_ = std::make_unique<SerialSink>();
  Backlog backlog_;
  health::MemoryCheck check_{{}};
  Life life_{machine_.clock().now_us()};
  std::unique_ptr<Target> target_ = std::make_unique<Target>(ThreeLux::kVehicle, kConfig.peer.value,
                                                             platform_, Coding::kRaw, *serial_);
  SlowTarget slow_;
};

// docs/spec.md 3.7: six of them say how the cores share the work.
TEST(Loop, TheLinkCountersHoldThoseOfTheCores) {
  FakeMachine machine;
  machine.cores().machine_has = 4;
  machine.cores().comes_up[2] = false;
  MachinePlatform<FakeMachine> platform(machine, kConfig, 4);
  machine.cores().states[3] = hal::CoreState::kFaulted;
  platform.share(5, {.run = [](void*, std::size_t, std::size_t) {}});
  const Vitals vitals = platform.vitals();
  ASSERT_GE(vitals.link_counter_count, stream::kCoreCounters + 6);
  const auto of_cores = std::span(vitals.link_counters).subspan<stream::kCoreCounters, 6>();
  EXPECT_EQ(of_cores[0], 2U);
  EXPECT_EQ(of_cores[1], 0U);
  EXPECT_EQ(of_cores[2] + of_cores[3] + of_cores[4] + of_cores[5], 5U);
}

// docs/spec.md 3.7: four are the port's. What was received and lost is a loss of packets.
TEST(Loop, TheLinkCountersHoldWhatThePortLost) {
  FakeMachine machine;
  MachinePlatform<FakeMachine> platform(machine, kConfig);
  const std::uint32_t drops = platform.vitals().link_drops;
  machine.ethernet().overflow();
  machine.ethernet().start_anew(3, 5);
  machine.ethernet().start_anew(4, 0);
  const Vitals vitals = platform.vitals();
  ASSERT_GE(vitals.link_counter_count, stream::kCoreCounters + 10);
  EXPECT_EQ(vitals.link_counters[stream::kCoreCounters + 6], 1U);
  EXPECT_EQ(vitals.link_counters[stream::kCoreCounters + 7], 2U);
  EXPECT_EQ(vitals.link_counters[stream::kCoreCounters + 8], 7U);
  EXPECT_EQ(vitals.link_counters[stream::kCoreCounters + 9], 5U);
  EXPECT_EQ(vitals.link_drops, drops + 8);
}

// docs/spec.md 3.7: the last three say how often the target has started, and what ended the run
// before.
TEST(Loop, TheLinkCountersEndWithTheRunBefore) {
  FakeMachine machine;
  machine.before = {.starts = 7, .end = {.cause = hal::EndCause::kMemory, .detail = 9}};
  MachinePlatform<FakeMachine> platform(machine, kConfig);
  const Vitals vitals = platform.vitals();
  ASSERT_EQ(vitals.link_counter_count, stream::kEndCounters + 3);
  EXPECT_EQ(vitals.link_counters[stream::kEndCounters], 7U);
  EXPECT_EQ(vitals.link_counters[stream::kEndCounters + 1], 4U);
  EXPECT_EQ(vitals.link_counters[stream::kEndCounters + 2], 9U);
}

// It takes the emulated board longer to set up the pipeline's memory than two frames last.
TEST(Loop, SilenceIsCountedFromTheStart) {
  constexpr std::uint64_t kSetUpUs = 1'000'000;
  tests::FakePlatform platform;
  const auto pipeline = std::make_unique<Pipeline<tests::FakePlatform>>(
      ThreeLux::kVehicle, kConfig.peer.value, platform);
  pipeline->start(kSetUpUs);
  EXPECT_EQ(pipeline->deadline_us(), kSetUpUs + 2 * kPeriodUs);
  pipeline->tick(kSetUpUs + 2 * kPeriodUs - 1);
  EXPECT_TRUE(platform.frames.empty());
  pipeline->tick(kSetUpUs + 2 * kPeriodUs);
  ASSERT_EQ(platform.frames.size(), 1U);
  EXPECT_EQ(platform.frames[0].end.opened_us, kSetUpUs);
}

// In a sound packet or not, in time or not.
TEST(Loop, EveryPointHasAFate) {
  tests::FakePlatform platform;
  const auto pipeline = std::make_unique<Pipeline<tests::FakePlatform>>(
      ThreeLux::kVehicle, kConfig.peer.value, platform);
  LuxMessage half{.scan_number = 1, .start_ticks = 1600, .end_ticks = 0, .points = {}};
  half.points.assign(40, {.angle_ticks = 5, .range_cm = 1000});
  const std::vector<std::byte> first = half.bytes();
  half.end_ticks = -1600;
  const std::vector<std::byte> second = half.bytes();
  std::vector<std::byte> wrong = first;
  wrong.at(68) = std::byte{0x0F};  // layer 15
  const std::uint32_t peer = kConfig.peer.value;
  pipeline->take({peer, 100, first}, 0);
  pipeline->take({peer, 100, first}, 0);
  pipeline->take({peer, 101, wrong}, 0);
  pipeline->leave({peer, 102, first}, 0);
  pipeline->tick(kPeriodUs);
  pipeline->take({peer, 100, second}, kPeriodUs + 1);  // late
  pipeline->tick(4 * kPeriodUs);
  ASSERT_EQ(platform.frames.size(), 2U);
  const auto points = [&](std::size_t frame, Fate fate) {
    return platform.frames[frame].end.fates[static_cast<std::size_t>(fate)];
  };
  EXPECT_EQ(points(0, Fate::kStale), 40U);
  EXPECT_EQ(points(0, Fate::kMalformed), 40U);
  EXPECT_EQ(points(0, Fate::kNotTaken), 40U);
  EXPECT_EQ(points(1, Fate::kStale), 40U);
  EXPECT_EQ(platform.frames[0].header.points_used + platform.frames[0].header.points_other, 160U);
  EXPECT_EQ(platform.frames[1].header.points_other, 40U);
}

TEST(Loop, ATargetThatKeepsUpLeavesNothing) {
  Bench bench(500);
  bench.run(2'000'000);
  EXPECT_EQ(bench.points(Fate::kNotTaken), 0U);
  EXPECT_EQ(bench.timed_out(), 0U);
  EXPECT_GE(bench.receiver.frames.size(), 48U);
  EXPECT_LE(bench.oldest_scans, 1U);
}

// A second's 600 datagrams are more than the ring holds.
TEST(Loop, WhatTheControllerHasNoRoomForIsCountedAsDropped) {
  Bench bench(500);
  bench.run(200'000);
  bench.stall(1'000'000);
  bench.run(200'000);
  EXPECT_NEAR(bench.overflows(), 600 - kRingFrames, 30);
  EXPECT_GE(bench.receiver.frames.back().header.packets_dropped, bench.overflows());
}

// 24 datagrams of 3 ms are 72 ms of work for 40 ms of time.
TEST(Loop, ATargetThatIsTooSlowSaysSo) {
  constexpr std::uint64_t kDurationUs = 2'400'000;
  Bench bench(3'000);
  bench.run(kDurationUs);
  const std::uint64_t taken = bench.all_points();
  const std::uint64_t sent = bench.traffic.sent() * kPointsPerMessage;
  EXPECT_EQ(bench.overflows(), 0U);
  // Each point has a fate, but for those that still wait.
  EXPECT_LE(taken, sent);
  EXPECT_GE(taken + kRingFrames * kPointsPerMessage, sent);
  // What is not taken is what there is no time for: 32 of 72. All else has taken its time, too late
  // for its frame or not.
  EXPECT_NEAR(static_cast<double>(bench.points(Fate::kNotTaken)) / static_cast<double>(taken),
              32.0 / 72, 0.1);
  // Nothing piles up: the frames are of now, and they go out on time.
  EXPECT_LE(bench.oldest_scans, 3U);
  for (const tests::ReceivedFrame& frame : bench.receiver.frames) {
    if (frame.header.has_evidence()) {
      EXPECT_LE(frame.header.closed_us - frame.end.opened_us, kPeriodUs + 2 * 3'000);
    }
  }
  EXPECT_GE(bench.receiver.frames.size(), kDurationUs / kPeriodUs / 2);
}

// What has not waited for the loop itself is no sign of it: a PC that emulates a board is busy now
// and then.
TEST(Loop, AMachineThatStandsStillForAWhileCatchesUp) {
  Bench bench(500);
  for (int i = 0; i < 10; ++i) {
    bench.run(200'000);
    bench.stall(90'000);
  }
  EXPECT_EQ(bench.points(Fate::kNotTaken), 0U);
  EXPECT_EQ(bench.overflows(), 0U);
}

// docs/spec.md 3.11: one message a second, of type 4, whatever comes in; ping and ARP as always.
TEST(RefusedCar, SaysWhyOnceASecondAndNothingElse) {
  FakeMachine machine;
  MachinePlatform<FakeMachine> platform(machine, kConfig);
  RefusedCar<FakeMachine> refused(machine, platform, {.reason = 4, .words = "it is damaged"});
  machine.ethernet().arrive(net::testing::linux_arp_reply());
  std::vector<Frame> messages;
  std::size_t others = 0;
  for (int pass = 0; pass < 35'000; ++pass) {  // 3.5 s
    if (pass % 100 == 0) {
      machine.ethernet().arrive(datagram_to(100, LuxMessage{.points = {}}.bytes()));
    }
    if (!refused.pass()) {
      machine.idle();
    }
    for (const Frame& frame : machine.ethernet().take_sent()) {
      if (net::testing::be16(frame, 12) == 0x0800) {
        messages.push_back(frame);
      } else {
        ++others;
      }
    }
  }
  ASSERT_GE(messages.size(), 3U);
  EXPECT_LE(messages.size(), 4U);
  EXPECT_LE(others, 4U);  // it asks for its peer
  const std::span<const std::byte> content =
      std::span(messages.front()).subspan(net::testing::kPayloadOffset + 28);
  EXPECT_EQ(content[0], std::byte{4});
  const std::span<const std::byte> body = content.subspan(48);
  EXPECT_EQ(body[0], std::byte{4});
  EXPECT_EQ(body[1], std::byte{13});
  const std::string_view words(reinterpret_cast<const char*>(body.data()) + 4, 13);
  EXPECT_EQ(words, "it is damaged");
  EXPECT_EQ(body.size(), 4U + 13);
}

}  // namespace
}  // namespace iog::app
