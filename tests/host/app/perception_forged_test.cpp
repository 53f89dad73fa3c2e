// Pose messages that nobody should have sent do not stop the window's time.
#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>
#include <string>
#include <vector>

#include "fakes/effort.hpp"
#include "fakes/test_vehicles.hpp"
#include "perception_bench.hpp"
#include "pose/limits.hpp"

namespace iog::app {
namespace {

using testing::Car;
using testing::kPeriodUs;
using testing::kStartUs;
using testing::kWallM;
using testing::PerceptionBench;
using testing::TimedDatagram;

constexpr std::uint64_t kForgedUs = 20 * kPeriodUs + 1'000;
constexpr std::uint64_t kAgainUs = kForgedUs + 900'000;
constexpr std::uint64_t kEndUs = kAgainUs + 20 * kPeriodUs;
constexpr std::uint64_t kMuchLaterUs = kEndUs + 10'000'000;

// Three messages of a run, the last with that clock.
std::vector<TimedDatagram> forged(std::uint64_t clock_us, std::uint32_t run) {
  std::vector<TimedDatagram> datagrams;
  for (std::uint64_t before = 3; before-- > 0;) {
    pose::Message message = testing::pose_at(0, run);
    message.clock_us = clock_us - before * 10'000;
    datagrams.push_back(testing::datagram_of(message));
    datagrams.back().now_us = kForgedUs + (2 - before) * 100;
  }
  return datagrams;
}

// Poses and scans until someone forges, then nothing, then poses of a run and scans again; at the
// end poses alone.
struct Case {
  std::uint32_t run_again;
  bool is_synchronised;
  std::vector<TimedDatagram> forged;
};

struct Outcome {
  std::size_t known = 0;  // when the scans end
  std::size_t left = 0;   // ten seconds later
  std::uint64_t passed_us = 0;
  std::uint64_t longest_step_us = 0;  // of the stamp, from one frame to the next
};

std::uint64_t longest_step_us(const std::vector<testing::PlaceReport>& reports) {
  std::uint64_t longest_us = 0;
  for (std::size_t frame = 1; frame < reports.size(); ++frame) {
    longest_us = std::max(longest_us, reports[frame].stamp_us - reports[frame - 1].stamp_us);
  }
  return longest_us;
}

Outcome outcome_of(const Case& one) {
  const Car car(tests::OneLux::kVehicle, one.is_synchronised, one.is_synchronised ? 0 : 1'000);
  PerceptionBench bench(car.vehicle());
  auto drive = testing::poses(0, kForgedUs - 5'000);
  std::ranges::copy(one.forged, std::back_inserter(drive));
  std::ranges::move(testing::poses(kAgainUs, kEndUs, one.run_again), std::back_inserter(drive));
  for (int frame = 1; frame <= 64; ++frame) {
    const std::uint64_t end_us = static_cast<std::uint64_t>(frame) * kPeriodUs;
    if (end_us < kForgedUs || end_us > kAgainUs) {
      std::ranges::move(testing::scan_of_wall(100, frame, 4, end_us, kWallM),
                        std::back_inserter(drive));
    }
  }
  std::erase_if(drive, [](const TimedDatagram& datagram) { return datagram.now_us > kEndUs; });
  bench.take(drive);
  const std::size_t known = bench.classes.cells.size();
  const std::uint64_t stamp_us = bench.report().stamp_us;
  bench.take(testing::poses(kEndUs, kMuchLaterUs, one.run_again));
  bench.pass_until(kMuchLaterUs);
  return {.known = known,
          .left = bench.classes.cells.size(),
          .passed_us = bench.report().stamp_us - stamp_us,
          .longest_step_us = longest_step_us(bench.classes.reports)};
}

// Of the present run before scanners with a clock, of another one before one without; where a step
// is slow each clock is forged in one of the two alone.
TEST(PerceptionForged, NoClockOfAPoseStopsTheWindowsTime) {
  for (const std::uint32_t run : {1U, 3U}) {
    const bool is_synchronised = run == 1U;
    const Outcome control = outcome_of({2, is_synchronised, {}});
    EXPECT_GT(control.known, 1'000U);
    EXPECT_EQ(control.left, 0U);
    EXPECT_NEAR(static_cast<double>(control.passed_us), 10e6, 100e3);
    bool is_due = is_synchronised;
    for (const std::uint64_t clock_us :
         {~std::uint64_t{0}, ~std::uint64_t{0} >> 1U, pose::kMaxClockUs, kStartUs + 3'600'000'000,
          kStartUs + 2'500'000, std::uint64_t{30'000}}) {
      is_due = !is_due;
      if (!tests::kIsQuick && !is_due) {
        continue;
      }
      const Outcome outcome = outcome_of({2, is_synchronised, forged(clock_us, run)});
      SCOPED_TRACE(std::to_string(clock_us) + " of run " + std::to_string(run));
      EXPECT_EQ(outcome.known, control.known);
      EXPECT_EQ(outcome.left, 0U);
      EXPECT_NEAR(static_cast<double>(outcome.passed_us), 10e6, 100e3);
      EXPECT_LE(outcome.longest_step_us, pose::kMaxLeapUs + 2 * kPeriodUs);
    }
  }
}

// From one end of the range to the other: each of these runs is believed, in a frame of its own.
TEST(PerceptionForged, ManyLastClocksDoNotAddUp) {
  std::vector<TimedDatagram> many;
  for (std::uint32_t run = 3; run < 13; ++run) {
    std::ranges::move(forged(run % 2 == 0 ? 30'000 : pose::kMaxClockUs, run),
                      std::back_inserter(many));
    for (auto datagram = many.end() - 3; datagram != many.end(); ++datagram) {
      datagram->now_us += (run - 3) * 85'000ULL;
    }
  }
  const Outcome outcome = outcome_of({2, true, many});
  EXPECT_EQ(outcome.known, outcome_of({2, true, {}}).known);
  EXPECT_EQ(outcome.left, 0U);
  EXPECT_LE(outcome.longest_step_us, pose::kMaxLeapUs + 2 * kPeriodUs);
}

// The target was on for a minute when the first source came, whose clock began with it.
TEST(PerceptionForged, AClockThatBeganAfterTheTargetsMovesTheWindowsTime) {
  const Car car(tests::OneLux::kVehicle, false, 1'000);
  PerceptionBench bench(car.vehicle());
  constexpr std::uint64_t kBeginUs = 60'000'000;
  bench.pipeline->start(0);
  bench.pass_until(kBeginUs);
  const auto poses = [&](std::uint64_t begin_us, std::uint64_t end_us) {
    auto datagrams = testing::poses(begin_us, end_us);
    for (TimedDatagram& datagram : datagrams) {
      pose::Message message = testing::pose_at(datagram.now_us - testing::kPoseAgeUs);
      message.clock_us -= kStartUs;
      const std::uint64_t now_us = datagram.now_us;
      datagram = testing::datagram_of(message);
      datagram.now_us = kBeginUs + now_us;
    }
    return datagrams;
  };
  auto drive = poses(0, 20 * kPeriodUs);
  for (int frame = 1; frame <= 20; ++frame) {
    for (TimedDatagram& datagram : testing::scan_of_wall(
             100, frame, 4, static_cast<std::uint64_t>(frame) * kPeriodUs, kWallM)) {
      datagram.now_us += kBeginUs;
      drive.push_back(std::move(datagram));
    }
  }
  bench.take(drive);
  EXPECT_GT(bench.classes.cells.size(), 1'000U);
  bench.take(poses(20 * kPeriodUs, 20 * kPeriodUs + 10'000'000));
  bench.pass_until(kBeginUs + 20 * kPeriodUs + 10'000'000);
  EXPECT_EQ(bench.classes.cells.size(), 0U);
}

}  // namespace
}  // namespace iog::app
