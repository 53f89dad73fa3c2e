#include "app/scan_tracker.hpp"

#include <gtest/gtest.h>

namespace iog::app {
namespace {

using Verdict = ScanTracker::Verdict;

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

ScanTracker lux_tracker() { return {11520, 3200}; }
ScanTracker turn_tracker() { return {36'000, 36'000}; }

TEST(ScanTracker, AScanIsCompleteWhenItsSectorsCoverItsWidthInAnyOrder) {
  const lidar::PacketInfo parts[] = {lux_packet(5, 9920, 1000), lux_packet(5, 10'920, 1200),
                                     lux_packet(5, 600, 1000)};
  for (const auto& order : {std::array{0, 1, 2}, std::array{2, 0, 1}, std::array{1, 2, 0}}) {
    ScanTracker tracker = lux_tracker();
    for (const int i : order) {
      EXPECT_FALSE(tracker.is_complete());
      ASSERT_EQ(tracker.judge(parts[i]), Verdict::kPartOfFrame);
      tracker.accept(parts[i]);
    }
    EXPECT_TRUE(tracker.is_complete());
    EXPECT_EQ(tracker.packets(), 3);
    EXPECT_EQ(tracker.points(), 300U);
    EXPECT_EQ(tracker.scan_number(), 5U);
  }
}

TEST(ScanTracker, TheSamePacketTwiceIsADuplicateEvenInTheNextFrame) {
  ScanTracker tracker = lux_tracker();
  const auto packet = lux_packet(5, 9920, 3200);
  tracker.accept(packet);
  EXPECT_EQ(tracker.judge(packet), Verdict::kDuplicate);
  tracker.start_frame();
  EXPECT_EQ(tracker.judge(packet), Verdict::kDuplicate);
}

TEST(ScanTracker, AnotherScanNumberEndsTheFrame) {
  ScanTracker tracker = lux_tracker();
  tracker.accept(lux_packet(65'535, 9920, 1000));
  EXPECT_EQ(tracker.judge(lux_packet(0, 9920, 1000)), Verdict::kNextScan);  // it wraps
  EXPECT_EQ(tracker.judge(lux_packet(7, 9920, 1000)), Verdict::kNextScan);
  EXPECT_EQ(tracker.judge(lux_packet(65'535, 10'920, 1000)), Verdict::kPartOfFrame);
}

TEST(ScanTracker, APartOfAnEarlierScanIsLate) {
  ScanTracker tracker = lux_tracker();
  tracker.accept(lux_packet(2, 9920, 1000));
  EXPECT_EQ(tracker.judge(lux_packet(1, 10'920, 1000)), Verdict::kLate);
  EXPECT_EQ(tracker.judge(lux_packet(65'534, 10'920, 1000)), Verdict::kLate);
  tracker.start_frame();
  EXPECT_EQ(tracker.judge(lux_packet(2, 10'920, 1000)), Verdict::kLate);
  EXPECT_EQ(tracker.judge(lux_packet(3, 10'920, 1000)), Verdict::kPartOfFrame);
}

TEST(ScanTracker, ARestartedSensorIsNotLateForEver) {
  ScanTracker tracker = lux_tracker();
  tracker.accept(lux_packet(40'000, 9920, 3200));
  tracker.start_frame();
  EXPECT_EQ(tracker.judge(lux_packet(1, 9920, 3200)), Verdict::kPartOfFrame);
}

TEST(ScanTracker, ATurnIsCompleteWhereverItBegan) {
  for (const int begin : {0, 17, 74}) {
    ScanTracker tracker = turn_tracker();
    int packets = 0;
    while (!tracker.is_complete()) {
      const auto packet = turn_packet(begin + packets);
      ASSERT_EQ(tracker.judge(packet), Verdict::kPartOfFrame);
      tracker.accept(packet);
      ++packets;
    }
    EXPECT_EQ(packets, 75);
  }
}

TEST(ScanTracker, SweepingTheSameSectorAgainIsTheNextTurn) {
  ScanTracker tracker = turn_tracker();
  for (int i = 0; i < 70; ++i) {  // five packets are missing
    tracker.accept(turn_packet(i));
  }
  EXPECT_FALSE(tracker.is_complete());
  EXPECT_EQ(tracker.judge(turn_packet(75)), Verdict::kNextScan);
  EXPECT_EQ(tracker.judge(turn_packet(72)), Verdict::kPartOfFrame);
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

}  // namespace
}  // namespace iog::app
