// The loop on a machine that takes its time: what it cannot do in time is left and counted, and
// nothing piles up.
#include "app/loop.hpp"

#include <algorithm>
#include <array>
#include <gtest/gtest.h>
#include <memory>
#include <string_view>
#include <vector>

#include "app/refused_car.hpp"
#include "fake_machine.hpp"
#include "fakes/fake_platform.hpp"
#include "fakes/lux_message.hpp"
#include "fakes/random.hpp"
#include "loop_bench.hpp"
#include "net/frames.hpp"

namespace iog::app {
namespace {

using net::testing::Frame;
using net::testing::kConfig;
using testing::Bench;
using testing::Costs;
using testing::FakeMachine;
using testing::kPeriodUs;
using testing::kPointsPerMessage;
using testing::kRingFrames;
using tests::LuxMessage;
using tests::ThreeLux;
using vehicle::Fate;

TEST(Loop, TheLinkCountersHoldThoseOfTheCores) {
  FakeMachine machine;
  machine.cores().machine_has = 4;
  machine.cores().comes_up[2] = false;
  MachinePlatform<FakeMachine> platform(machine, kConfig, 4);
  machine.cores().states[3] = hal::CoreState::kFaulted;
  const work::Work nothing{.run = [](void*, std::size_t, std::size_t) {}};
  machine.cores().comes[1] = true;
  platform.share(5, nothing);
  machine.cores().comes[1] = false;
  platform.share(7, nothing);
  const Vitals vitals = platform.vitals({});
  const auto of_cores =
      std::span(vitals.link_counters).subspan<stream::place_of("cores at work"), 6>();
  constexpr std::array<std::uint32_t, 6> kSaid{2, 0, 7, 5, 0, 0};  // at work, done anew, by core
  EXPECT_TRUE(std::ranges::equal(of_cores, kSaid));
}

// What was received and lost is a loss of packets.
TEST(Loop, TheLinkCountersHoldWhatThePortLost) {
  FakeMachine machine;
  MachinePlatform<FakeMachine> platform(machine, kConfig);
  const std::uint32_t drops = platform.vitals({}).link_drops;
  machine.ethernet().overflow();
  machine.ethernet().start_anew(3, 5);
  machine.ethernet().start_anew(4, 0);
  const Vitals vitals = platform.vitals({});
  EXPECT_EQ(vitals.link_counters[stream::place_of("port without room")], 1U);
  EXPECT_EQ(vitals.link_counters[stream::place_of("port restarts")], 2U);
  EXPECT_EQ(vitals.link_counters[stream::place_of("received lost by restarts")], 7U);
  EXPECT_EQ(vitals.link_counters[stream::place_of("unsent lost by restarts")], 5U);
  EXPECT_EQ(vitals.link_drops, drops + 8);
}

TEST(Loop, TheVitalsHaveTheChipsTemperature) {
  FakeMachine machine;
  MachinePlatform<FakeMachine> platform(machine, kConfig);
  EXPECT_EQ(platform.vitals({}).temperature_dc, hal::kTemperatureNotKnown);
  machine.temperature = -55;
  EXPECT_EQ(platform.vitals({}).temperature_dc, -55);
}

TEST(Loop, TheLinkCountersHoldTheRunBefore) {
  FakeMachine machine;
  machine.before = {.starts = 7, .end = {.cause = hal::EndCause::kMemory, .detail = 9}};
  MachinePlatform<FakeMachine> platform(machine, kConfig);
  const Vitals vitals = platform.vitals({});
  EXPECT_EQ(vitals.link_counters[stream::place_of("starts since power-up")], 7U);
  EXPECT_EQ(vitals.link_counters[stream::place_of("end of the run before")], 4U);
  EXPECT_EQ(vitals.link_counters[stream::place_of("detail of that end")], 9U);
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

// One of three scans a thousand times a second, by its own stamps; the others 25 times, as the
// car's file says. It ends at most 100 frames, and of the others nothing is missing.
TEST(Loop, OneThatScansTooFastEndsFewFrames) {
  constexpr std::uint64_t kNtpUnitsPerMs = (std::uint64_t{1} << 32) / 1000;
  constexpr std::uint64_t kNtpOf1970 = std::uint64_t{2'208'988'800} << 32;
  tests::FakePlatform platform;
  const auto pipeline = std::make_unique<Pipeline<tests::FakePlatform>>(
      ThreeLux::kVehicle, kConfig.peer.value, platform);
  tests::Random random(79);
  const auto take = [&](int sensor, int number, int ms) {
    const std::uint64_t start = kNtpOf1970 + static_cast<std::uint64_t>(ms + 1) * kNtpUnitsPerMs;
    LuxMessage scan{.scan_number = number, .points = {}, .start_ntp = start, .end_ntp = start};
    for (int i = 0; i < 40; ++i) {
      scan.points.push_back({.angle_ticks = i, .range_cm = random.between(500, 900)});
    }
    pipeline->take({kConfig.peer.value, static_cast<std::uint16_t>(100 + sensor), scan.bytes()},
                   static_cast<std::uint64_t>(ms) * 1000);
  };
  for (int ms = 0; ms < 1000; ++ms) {
    take(0, ms, ms);
    if (ms % 40 == 17) {
      take(1, ms / 40, ms);
      take(2, ms / 40, ms);
    }
  }
  pipeline->tick(1'100'000);
  EXPECT_LE(platform.frames.size(), 101U);
  std::array<std::uint32_t, 3> complete{};
  for (const tests::ReceivedFrame& frame : platform.frames) {
    for (std::size_t sensor = 0; sensor < 3; ++sensor) {
      complete.at(sensor) +=
          frame.end.sensors[sensor].state == intake::SensorState::kComplete ? 1U : 0U;
    }
  }
  EXPECT_GT(complete[0], 90U);
  EXPECT_EQ(complete[1], 25U);
  EXPECT_EQ(complete[2], 25U);
  constexpr auto kTooSoon = static_cast<std::size_t>(intake::PacketDrop::kTooSoon);
  EXPECT_EQ(platform.frames.back().end.packet_drops[kTooSoon], 1000U - complete[0]);
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

// docs/safety.md: a receive ring, less what the sensors themselves send meanwhile, over the time
// that a frame's end takes. Below it nothing is lost; at eight times as much it is, and counted.
TEST(Loop, AFloodBelowTheStatedRateLosesNothing) {
  for (const std::uint64_t close_us : {7'000U, 21'400U, 37'800U}) {
    const std::uint64_t own = 24 * close_us / kPeriodUs + 1;
    const std::uint64_t rate = (kRingFrames - own) * 1'000'000 / close_us;
    Bench bench(Costs{.datagram_us = 50, .close_us = close_us, .pass_us = 10, .stranger_us = 2});
    bench.flood(rate * 95 / 100);
    bench.run(2'000'000);
    EXPECT_EQ(bench.overflows(), 0U) << rate;
    EXPECT_EQ(bench.points(Fate::kNotTaken), 0U) << rate;
    EXPECT_GE(bench.receiver.frames.size(), 48U) << rate;
    bench.flood(8 * rate);
    bench.run(2'000'000);
    EXPECT_GT(bench.overflows(), rate) << rate;
    EXPECT_LE(bench.longest_us(), 2 * kPeriodUs + close_us) << rate;
    EXPECT_GE(bench.receiver.frames.size(), 48U + 40U) << rate;
  }
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
  EXPECT_LE(bench.longest_us(), kPeriodUs + 2ULL * 3'000);
  EXPECT_GE(bench.receiver.frames.size(), kDurationUs / kPeriodUs / 2);
}

// The bound of docs/safety.md: fusing yields to the frame's end within a datagram, a second one
// that came while the loop slept, and what else a pass does, however slow all of it is; but what
// closes the frame before is not interrupted.
TEST(Loop, AFrameIsClosedOnTimeHoweverSlowTheTargetIs) {
  constexpr std::uint64_t kDurationUs = 1'000'000;
  constexpr std::array<Costs, 9> kCosts{{
      {.datagram_us = 100, .left_us = 700, .close_us = 61'000},
      {.datagram_us = 1'100, .left_us = 700, .close_us = 37'000},
      {.datagram_us = 1'100, .left_us = 10, .close_us = 130'000},
      {.datagram_us = 1'900, .left_us = 10},
      {.datagram_us = 1'900, .left_us = 700, .close_us = 37'000},
      {.datagram_us = 1'900, .left_us = 700, .close_us = 130'000},
      {.datagram_us = 3'000, .left_us = 700, .close_us = 11'000},
      {.datagram_us = 7'000, .left_us = 10},
      {.datagram_us = 7'000, .left_us = 700, .close_us = 61'000},
  }};
  constexpr std::uint64_t kPassUs = 90;
  for (Costs costs : kCosts) {
    costs.pass_us = kPassUs;
    Bench bench(costs);
    bench.run(kDurationUs);
    const auto name = ::testing::Message()
                      << costs.datagram_us << ", " << costs.left_us << ", " << costs.close_us;
    const std::uint64_t most_us = std::max(kPeriodUs, costs.datagram_us + costs.close_us) +
                                  2 * costs.datagram_us + costs.left_us + kPassUs;
    EXPECT_LE(bench.longest_us(), most_us) << name;
    // Frames go on: each takes a period of datagrams, and its end.
    EXPECT_GE(bench.receiver.frames.size(),
              kDurationUs / (2 * kPeriodUs + Backlog::kLongestUs + 2 * costs.close_us))
        << name;
    // Nothing piles up: nothing that goes out is older than what may wait, and two closings.
    EXPECT_LE(bench.oldest_scans,
              2 + (Backlog::kLongestUs + 2 * costs.close_us + kPeriodUs) / kPeriodUs)
        << name;
    EXPECT_EQ(bench.overflows(), 0U) << name;
  }
}

// A frame that was over before the loop woke takes in what has come meanwhile, but not for ever.
TEST(Loop, AFrameThatWasOverBeforeTheLoopWokeIsClosedAfterTheGrace) {
  constexpr std::uint64_t kStallUs = 90'000;
  constexpr std::uint64_t kDatagramUs = 9'000;
  Bench bench(500);
  bench.run(210'000);
  bench.stall(kStallUs);
  bench.costs().datagram_us = kDatagramUs;
  bench.run(200'000);
  EXPECT_GT(bench.longest_us(), kStallUs);
  EXPECT_LE(bench.longest_us(), kStallUs + kPeriodUs + Backlog::kGraceUs + 2 * kDatagramUs);
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
      machine.ethernet().arrive(testing::datagram_to(100, LuxMessage{.points = {}}.bytes()));
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
