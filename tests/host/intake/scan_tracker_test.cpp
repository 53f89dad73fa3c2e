#include "intake/scan_tracker.hpp"

#include <gtest/gtest.h>

#include "fakes/effort.hpp"
#include "fakes/velodyne_packet.hpp"
#include "lidar/velodyne_vlp16.hpp"

namespace iog::intake {
namespace {

using Outcome = ScanTracker::Outcome;

lidar::PacketInfo lux_packet(std::uint32_t scan, std::uint16_t first, std::uint16_t width) {
  static std::uint64_t fingerprint = 0;
  return {.fingerprint = ++fingerprint,
          .scan_number = scan,
          .point_count = 100,
          .sector = {first, width}};
}

// A turn of a VLP-16: no scan number, packets of 4.8 degrees.
lidar::PacketInfo turn_packet(int number) {
  static std::uint64_t fingerprint = 1'000'000;
  return {.fingerprint = ++fingerprint,
          .scan_number = 0,
          .point_count = 384,
          .sector = {static_cast<std::uint16_t>(number * 480 % 36'000), 480}};
}

// A packet of an Ouster: a numbered turn of 128 packets.
lidar::PacketInfo numbered_packet(std::uint32_t turn, int number) {
  lidar::PacketInfo packet = turn_packet(0);
  packet.scan_number = turn;
  packet.sector = {static_cast<std::uint16_t>(number % 128 * 360), 360};
  return packet;
}

ScanTracker lux_tracker() { return {false, 11520, 3200}; }
ScanTracker turn_tracker() { return {true, 36'000, 36'000}; }
ScanTracker numbered_tracker() { return {true, 46'080, 46'080}; }

using Three = std::array<lidar::PacketInfo, 3>;

// Three packets of one scan, of which each is waited for, whichever comes last.
void expect_whole_with_all(const Three& parts) {
  Three order = parts;
  for (int first = 0; first < 3; ++first) {
    ScanTracker tracker = lux_tracker();
    for (const lidar::PacketInfo& part : order) {
      EXPECT_FALSE(tracker.is_complete());
      ASSERT_EQ(tracker.classify(part), Outcome::kPartOfFrame);
      tracker.accept(part);
    }
    EXPECT_TRUE(tracker.is_complete());
    EXPECT_EQ(tracker.packets(), 3);
    EXPECT_EQ(tracker.points(), 300U);
    EXPECT_EQ(tracker.scan_number(), 5U);
    std::rotate(order.begin(), order.begin() + 1, order.end());
  }
}

TEST(ScanTracker, AScanIsCompleteWhenItsSectorsCoverItsWidthInAnyOrder) {
  expect_whole_with_all(
      {lux_packet(5, 9920, 1000), lux_packet(5, 10'920, 1200), lux_packet(5, 600, 1000)});
}

// 30 ticks between two whole degrees (multiples of 32): without them the scan is not whole.
TEST(ScanTracker, ASectorWithoutAWholeDegreeIsWaitedFor) {
  expect_whole_with_all(
      {lux_packet(5, 9920, 993), lux_packet(5, 10'913, 30), lux_packet(5, 10'943, 2177)});
}

TEST(ScanTracker, TheSamePacketTwiceIsADuplicateEvenInTheNextFrame) {
  ScanTracker tracker = lux_tracker();
  const auto packet = lux_packet(5, 9920, 3200);
  tracker.accept(packet);
  EXPECT_EQ(tracker.classify(packet), Outcome::kDuplicate);
  tracker.start_frame();
  EXPECT_EQ(tracker.classify(packet), Outcome::kDuplicate);
}

TEST(ScanTracker, AnotherScanNumberEndsTheFrame) {
  ScanTracker tracker = lux_tracker();
  tracker.accept(lux_packet(65'535, 9920, 1000));
  EXPECT_EQ(tracker.classify(lux_packet(0, 9920, 1000)), Outcome::kNextScan);  // it wraps
  EXPECT_EQ(tracker.classify(lux_packet(7, 9920, 1000)), Outcome::kNextScan);
  EXPECT_EQ(tracker.classify(lux_packet(65'535, 10'920, 1000)), Outcome::kPartOfFrame);
}

TEST(ScanTracker, APartOfAnEarlierScanIsLate) {
  ScanTracker tracker = lux_tracker();
  tracker.accept(lux_packet(2, 9920, 1000));
  EXPECT_EQ(tracker.classify(lux_packet(1, 10'920, 1000)), Outcome::kLate);
  EXPECT_EQ(tracker.classify(lux_packet(65'534, 10'920, 1000)), Outcome::kLate);
  tracker.start_frame();
  EXPECT_EQ(tracker.classify(lux_packet(2, 10'920, 1000)), Outcome::kLate);
  EXPECT_EQ(tracker.classify(lux_packet(3, 10'920, 1000)), Outcome::kPartOfFrame);
}

// Where numbers wrap, 0 is a number as any other.
TEST(ScanTracker, APartOfAnEarlierScanIsLateThoughItsNumberIsZero) {
  ScanTracker tracker = lux_tracker();
  tracker.accept(lux_packet(65'535, 9920, 1000));
  tracker.start_frame();
  tracker.accept(lux_packet(0, 9920, 1000));
  EXPECT_EQ(tracker.classify(lux_packet(0, 9920, 1000)), Outcome::kPartOfFrame)
      << "the same sector twice is the same scan where scans have numbers";
  tracker.start_frame();
  EXPECT_EQ(tracker.classify(lux_packet(0, 10'920, 1000)), Outcome::kLate);
  EXPECT_EQ(tracker.classify(lux_packet(65'535, 10'920, 1000)), Outcome::kLate);
  EXPECT_EQ(tracker.classify(lux_packet(1, 9920, 1000)), Outcome::kPartOfFrame);
}

TEST(ScanTracker, ARestartedSensorIsNotLateForEver) {
  ScanTracker tracker = lux_tracker();
  tracker.accept(lux_packet(40'000, 9920, 3200));
  tracker.start_frame();
  EXPECT_EQ(tracker.classify(lux_packet(1, 9920, 3200)), Outcome::kPartOfFrame);
}

TEST(ScanTracker, ATurnIsCompleteWhereverItBegan) {
  for (const int begin : {0, 17, 74}) {
    ScanTracker tracker = turn_tracker();
    int packets = 0;
    while (!tracker.is_complete()) {
      const auto packet = turn_packet(begin + packets);
      ASSERT_EQ(tracker.classify(packet), Outcome::kPartOfFrame);
      tracker.accept(packet);
      ++packets;
    }
    EXPECT_EQ(packets, 75);
  }
}

// The packets of a real turn (MRPT's recording on a desk, 2016): the head's speed wavers, so that a
// packet cannot tell exactly where the next one begins.
TEST(ScanTracker, ATurnIsCompleteThoughTheHeadsSpeedWavers) {
  for (int begin = 0; begin < 36'000; begin += tests::effort(7, 97)) {
    ScanTracker tracker = turn_tracker();
    int azimuth = begin;
    int packets = 0;
    while (azimuth < begin + 36'000) {
      // Within the packet each block turns 0.38 degrees, to the next packet it is 0.42.
      tests::VelodynePacket packet{.first_azimuth = azimuth % 36'000,
                                   .step = 38,
                                   .time_us = static_cast<std::uint32_t>(packets)};
      lidar::VelodyneVlp16 decoder;
      ASSERT_EQ(decoder.decode(packet.bytes()), lidar::DecodeStatus::kOk);
      ASSERT_EQ(tracker.classify(decoder.info()), Outcome::kPartOfFrame);
      tracker.accept(decoder.info());
      azimuth += 11 * 38 + 42;
      ++packets;
    }
    ASSERT_TRUE(tracker.is_complete()) << "from " << begin;
  }
}

TEST(ScanTracker, SweepingTheSameSectorAgainIsTheNextTurn) {
  ScanTracker tracker = turn_tracker();
  for (int i = 0; i < 70; ++i) {  // five packets are missing
    tracker.accept(turn_packet(i));
  }
  EXPECT_FALSE(tracker.is_complete());
  EXPECT_EQ(tracker.classify(turn_packet(75)), Outcome::kNextScan);
  EXPECT_EQ(tracker.classify(turn_packet(72)), Outcome::kPartOfFrame);
}

// A frame may be over before the turn is: its rest belongs to the next frames, and nothing of it is
// late. They go on over the beginning of the next turn.
TEST(ScanTracker, ATurnMayBeCutIntoFrames) {
  ScanTracker tracker = numbered_tracker();
  for (int number = 0; number < 10 * 128; ++number) {
    if (number % 51 == 0) {
      tracker.start_frame();
    }
    const auto packet = numbered_packet(static_cast<std::uint32_t>(65'530 + number / 128), number);
    ASSERT_EQ(tracker.classify(packet), Outcome::kPartOfFrame) << number;
    tracker.accept(packet);
    ASSERT_FALSE(tracker.is_complete());
  }
}

// Of two turns in a frame packets may come in any order; a turn whose frames are closed opens none.
TEST(ScanTracker, OfAnOlderTurnIsWhatIsMissing) {
  ScanTracker tracker = numbered_tracker();
  tracker.accept(numbered_packet(7, 127));
  tracker.start_frame();
  tracker.accept(numbered_packet(8, 0));
  EXPECT_EQ(tracker.classify(numbered_packet(7, 126)), Outcome::kPartOfFrame);
  tracker.accept(numbered_packet(7, 126));
  EXPECT_EQ(tracker.scan_number(), 8U);
  EXPECT_EQ(tracker.classify(numbered_packet(8, 1)), Outcome::kPartOfFrame);
  EXPECT_EQ(tracker.classify(numbered_packet(7, 0)), Outcome::kLate) << "swept by the newer turn";
  tracker.start_frame();
  EXPECT_EQ(tracker.classify(numbered_packet(7, 125)), Outcome::kLate);
  EXPECT_EQ(tracker.classify(numbered_packet(8, 1)), Outcome::kPartOfFrame);
}

// With gaps in the turn before, the next one is seen by what it sweeps again.
TEST(ScanTracker, ANumberedTurnThatSweepsAgainIsTheNext) {
  ScanTracker tracker = numbered_tracker();
  for (int number = 0; number < 120; ++number) {
    tracker.accept(numbered_packet(3, number));
  }
  EXPECT_EQ(tracker.classify(numbered_packet(4, 0)), Outcome::kNextScan);
}

// Packets of a Pandar64 in dual return mode: 0.7 degrees, each 0.1 into the one before. What two of
// them share is no sign of a new turn.
TEST(ScanTracker, NarrowPacketsThatOverlapAreOneTurn) {
  ScanTracker tracker = turn_tracker();
  for (int number = 0; number < 600; ++number) {
    ASSERT_FALSE(tracker.is_complete()) << number;
    lidar::PacketInfo packet = turn_packet(0);
    packet.sector = {static_cast<std::uint16_t>((36'055 - 60 * number) % 36'000), 70};
    ASSERT_EQ(tracker.classify(packet), Outcome::kPartOfFrame) << number;
    tracker.accept(packet);
  }
  EXPECT_TRUE(tracker.is_complete());
}

TEST(ScanTracker, CountsTheFramesSinceItWasSeen) {
  ScanTracker tracker = lux_tracker();
  EXPECT_FALSE(tracker.was_ever_seen());
  tracker.accept(lux_packet(1, 9920, 3200));
  EXPECT_EQ(tracker.age_frames(), 0);
  tracker.start_frame();
  tracker.start_frame();
  EXPECT_EQ(tracker.age_frames(), 2);
  EXPECT_TRUE(tracker.was_ever_seen());
  EXPECT_FALSE(tracker.is_complete());
}

// Scans of a whole width, every so many us, and how many of them are taken in a second.
int scans_taken(ScanTracker tracker, std::uint64_t every_us, lidar::PacketInfo packet) {
  int taken = 0;
  for (std::uint64_t time_us = every_us; time_us <= 1'000'000; time_us += every_us) {
    ++packet.fingerprint;
    ++packet.scan_number;
    packet.sweep.begin_us = 1'000'000'000 + time_us;
    if (tracker.classify(packet) == Outcome::kTooSoon) {
      continue;
    }
    if (tracker.classify(packet) == Outcome::kNextScan) {
      tracker.start_frame();
    }
    EXPECT_EQ(tracker.classify(packet), Outcome::kPartOfFrame);
    tracker.accept(packet);
    ++taken;
  }
  return taken;
}

// A LUX scans 12.5, 25 or 50 times a second, units that turn do it 5 to 20 times.
TEST(ScanTracker, WhatAUnitCanDoIsTaken) {
  EXPECT_EQ(scans_taken(lux_tracker(), 80'000, lux_packet(1, 9920, 3200)), 12);
  EXPECT_EQ(scans_taken(lux_tracker(), 20'000, lux_packet(1, 9920, 3200)), 50);
  EXPECT_EQ(scans_taken(numbered_tracker(), 50'000, numbered_packet(1, 0)), 20);
}

// It ends at most 100 frames a second, or 40, however fast it says to scan.
TEST(ScanTracker, AScanThatBeginsTooSoonIsLeft) {
  for (const std::uint64_t every_us : {40U, 100U, 1'000U, 9'999U}) {
    EXPECT_LE(scans_taken(lux_tracker(), every_us, lux_packet(1, 9920, 3200)), 100) << every_us;
    EXPECT_LE(scans_taken(numbered_tracker(), every_us, numbered_packet(1, 0)), 40) << every_us;
  }
  EXPECT_GT(scans_taken(lux_tracker(), 1'000, lux_packet(1, 9920, 3200)), 90);
}

// A clock that is set back, or that nobody runs, is no reason to leave what was measured.
TEST(ScanTracker, StampsThatStandStillOrGoBackAreNotTooSoon) {
  ScanTracker tracker = lux_tracker();
  for (const std::uint64_t begin_us : {5'000'000U, 5'000'000U, 5'000'000U, 4'999'999U, 0U, 0U}) {
    lidar::PacketInfo packet = lux_packet(tracker.scan_number() + 1, 9920, 3200);
    packet.sweep.begin_us = begin_us;
    ASSERT_EQ(tracker.classify(packet), Outcome::kPartOfFrame) << begin_us;
    tracker.accept(packet);
    tracker.start_frame();
  }
}

// A turn at 10 Hz of 75 packets, of which the third is lost, while the unit's clock steps: after so
// many packets it counts on from another time. The next turn ends the frame with its first packet.
void expect_next_turn(std::uint64_t begin_us, int step_after, std::uint64_t then_us) {
  constexpr std::uint64_t kPacketUs = 1'333;
  ScanTracker tracker = turn_tracker();
  lidar::PacketInfo packet;
  for (int number = 0; number <= 75; ++number) {
    packet = turn_packet(number);
    const bool has_stepped = number >= step_after;
    packet.sweep.begin_us =
        has_stepped ? then_us + static_cast<std::uint64_t>(number - step_after) * kPacketUs
                    : begin_us + static_cast<std::uint64_t>(number) * kPacketUs;
    if (number < 75 && number != 2) {
      ASSERT_EQ(tracker.classify(packet), Outcome::kPartOfFrame) << number;
      tracker.accept(packet);
    }
  }
  EXPECT_EQ(tracker.classify(packet), Outcome::kNextScan) << begin_us << ", " << step_after;
}

// docs/spec.md 1.2: a Velodyne counts from the hour. When its clock is set, it steps anywhere.
TEST(ScanTracker, ATurnInWhichTheClockStepsIsNotTooSoon) {
  constexpr std::uint64_t kHourUs = 3'600'000'000;
  for (int step_after = 1; step_after <= 75; ++step_after) {
    expect_next_turn(kHourUs - 1'333U * static_cast<unsigned>(step_after), step_after, 7);
    expect_next_turn(1'000'000, step_after, 900'000);
    expect_next_turn(1'000'000, step_after, 1'700'000'000);
  }
}

}  // namespace
}  // namespace iog::intake
