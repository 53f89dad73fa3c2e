// What becomes of the window when poses or sensors are silent, jump, or begin anew.
#include <algorithm>
#include <gtest/gtest.h>
#include <iterator>
#include <vector>

#include "fakes/test_vehicles.hpp"
#include "perception_bench.hpp"

namespace iog::app {
namespace {

using testing::Car;
using testing::ClassName;
using testing::drive_at_wall;
using testing::kPeriodUs;
using testing::kWallM;
using testing::PerceptionBench;
using testing::TimedDatagram;

// Nothing is fused without a pose: what was known fades, and after a second it has no place.
TEST(PerceptionTime, WithoutPosesTheWindowAgesAndIsLost) {
  const Car car(tests::OneLux::kVehicle, true);
  PerceptionBench bench(car.vehicle());
  bench.take(drive_at_wall(20));
  const std::size_t known = bench.classes.cells.size();
  for (int frame = 21; frame <= 40; ++frame) {
    bench.take(testing::scan_of_wall(100, frame, 4, static_cast<std::uint64_t>(frame) * kPeriodUs,
                                     kWallM));
  }
  EXPECT_EQ(bench.end().packets_placed, 0U);
  EXPECT_EQ(bench.end().packets_not_placed, 4U);
  EXPECT_GT(bench.slices_by(pose::Cause::kLate), 30U);
  EXPECT_LT(bench.classes.cells.size(), known / 2);
  EXPECT_GT(bench.classes.cells.size(), 0U);
  int forgotten = 0;
  for (int frame = 41; frame <= 50; ++frame) {
    bench.take(testing::scan_of_wall(100, frame, 4, static_cast<std::uint64_t>(frame) * kPeriodUs,
                                     kWallM));
    forgotten += bench.report().is_forgotten ? 1 : 0;
  }
  EXPECT_EQ(forgotten, 1);
  EXPECT_EQ(bench.classes.names.back(), ClassName{});
  EXPECT_EQ(bench.end().causes[static_cast<std::size_t>(pose::Cause::kLost)].began.times, 1U);
}

// Silence is a frame, too. A tile is refreshed in one of eight frames, and in silence a frame takes
// 80 ms.
TEST(PerceptionTime, InSilenceOfTheSensorsTheWindowAges) {
  const Car car(tests::OneLux::kVehicle, true);
  PerceptionBench bench(car.vehicle());
  const std::uint64_t end_us = 20 * kPeriodUs;
  bench.take(drive_at_wall(20));
  const std::uint64_t stamp_us = bench.report().stamp_us;
  const std::size_t known = bench.classes.cells.size();
  bench.take(testing::poses(end_us, end_us + 1'000'000));
  bench.pass_until(end_us + 1'000'000);
  EXPECT_NEAR(static_cast<double>(bench.report().stamp_us - stamp_us), 1'000'000, 90'000);
  EXPECT_LT(bench.classes.cells.size(), known * 2 / 3);
}

// When the poses are silent, too, nobody says that time has passed, and a pause of whoever plays a
// drive does not show. After a second the poses are lost, and the target's own clock says it.
TEST(PerceptionTime, InASilenceOfAllNothingChangesUntilThePosesAreLost) {
  const Car car(tests::OneLux::kVehicle, true);
  PerceptionBench bench(car.vehicle());
  const std::uint64_t end_us = 20 * kPeriodUs;
  bench.take(drive_at_wall(20));
  const std::uint64_t stamp_us = bench.report().stamp_us;
  const ClassName name = bench.classes.names.back();
  bench.pass_until(end_us + 900'000);
  EXPECT_EQ(bench.classes.names.size(), 31U);
  EXPECT_EQ(bench.report().stamp_us, stamp_us);
  EXPECT_EQ(bench.classes.names.back(), name);
  bench.pass_until(end_us + 2'000'000);
  EXPECT_NEAR(static_cast<double>(bench.report().stamp_us - stamp_us), 2'000'000, 90'000);
  EXPECT_EQ(bench.classes.names.back(), ClassName{});
}

// Poses that come rarely, or just in time for a slice's middle: whatever was placed, the window's
// header has a pose that is one, or says that it is not known (docs/spec.md, 3.9).
TEST(PerceptionTime, WhatIsNotKnownAtTheEndIsNotStated) {
  const auto rare = [](const TimedDatagram& datagram) {
    return datagram.port == pose::kPosePort && datagram.now_us % 200'000 >= 10'000;
  };
  for (const bool are_late : {false, true}) {
    const Car car(tests::OneLux::kVehicle, true);
    PerceptionBench bench(car.vehicle());
    auto drive = drive_at_wall(100);
    if (!are_late) {
      std::erase_if(drive, rare);
    }
    for (TimedDatagram& datagram : drive) {
      if (are_late && datagram.port == pose::kPosePort) {
        datagram.now_us += 107'000;
      }
    }
    bench.take(drive);
    int not_known = 0;
    for (const auto& report : bench.classes.reports) {
      const stream::ClassWindow& window = report.end.window;
      const bool is_known = window.sigma != pose::Sigma{};
      not_known += is_known ? 0 : 1;
      EXPECT_EQ(window.sigma, is_known ? (pose::Sigma{10, 10}) : (pose::Sigma{0xFFFF, 0xFFFF}));
      EXPECT_EQ(window.pose == pose::Pose{}, !is_known);
    }
    EXPECT_GT(not_known, 10);
  }
}

// A PC that paused for 20 s in lockstep: the target's clock went on, that of the poses did not.
TEST(PerceptionTime, AfterALongPauseOfAllTheWindowAges) {
  const Car car(tests::OneLux::kVehicle, true);
  PerceptionBench bench(car.vehicle());
  constexpr std::uint64_t kPauseUs = 20'000'000;
  bench.take(drive_at_wall(20));
  bench.pass_until(20 * kPeriodUs + kPauseUs);
  const auto later = [](std::vector<TimedDatagram> datagrams) {
    for (TimedDatagram& datagram : datagrams) {
      datagram.now_us += kPauseUs;
    }
    return datagrams;
  };
  const std::uint64_t end_us = 40 * kPeriodUs;
  auto drive = later(testing::poses(20 * kPeriodUs, end_us));
  for (int frame = 21; frame <= 40; ++frame) {
    std::ranges::move(later(testing::scan_of_wall(
                          100, frame, 4, static_cast<std::uint64_t>(frame) * kPeriodUs, kWallM)),
                      std::back_inserter(drive));
  }
  bench.take(drive);
  EXPECT_GT(bench.classes.cells.size(), 1'000U);
  const std::uint64_t stamp_us = bench.report().stamp_us;
  bench.take(later(testing::poses(end_us, end_us + 10'000'000)));
  bench.pass_until(end_us + kPauseUs + 10'000'000);
  EXPECT_EQ(bench.classes.cells.size(), 0U);
  EXPECT_NEAR(static_cast<double>(bench.report().stamp_us - stamp_us), 10e6, 100e3);
}

TEST(PerceptionTime, AJumpOfThePosesForgetsTheWindow) {
  const Car car(tests::OneLux::kVehicle, true);
  PerceptionBench bench(car.vehicle());
  auto drive = drive_at_wall(20);
  for (TimedDatagram& datagram : drive) {
    if (datagram.port == pose::kPosePort && datagram.now_us > 600'000) {
      pose::Message message = testing::pose_at(datagram.now_us - testing::kPoseAgeUs);
      message.pose.y_mm += 500;
      datagram = testing::datagram_of(message);
    }
  }
  bench.take(drive);
  std::vector<std::size_t> forgotten;
  for (std::size_t frame = 0; frame < bench.classes.reports.size(); ++frame) {
    if (bench.classes.reports[frame].is_forgotten) {
      forgotten.push_back(frame);
    }
  }
  // The first pose beside comes at 602 ms, in the frame that ends at 640 ms, the sixteenth.
  EXPECT_EQ(forgotten, std::vector<std::size_t>{15});
  EXPECT_EQ(bench.end().causes[static_cast<std::size_t>(pose::Cause::kJump)].began.times, 1U);
  // What is known now is what was seen since: nothing beside the old place.
  EXPECT_GT(bench.classes.cells.size(), 1000U);
}

// The clock of a source that was started anew begins at 0: the window's time goes on.
TEST(PerceptionTime, AfterARestartOfThePosesTheWindowLivesOn) {
  const Car car(tests::OneLux::kVehicle, false, 1'000);
  PerceptionBench bench(car.vehicle());
  const auto scans = [](int first, int last) {
    std::vector<TimedDatagram> datagrams;
    for (int frame = first; frame <= last; ++frame) {
      std::ranges::move(testing::scan_of_wall(
                            100, frame, 4, static_cast<std::uint64_t>(frame) * kPeriodUs, kWallM),
                        std::back_inserter(datagrams));
    }
    return datagrams;
  };
  auto drive = scans(1, 40);
  std::ranges::move(testing::poses(0, 800'000), std::back_inserter(drive));
  const auto anew = [](std::uint64_t begin_us, std::uint64_t end_us) {
    std::vector<TimedDatagram> datagrams = testing::poses(begin_us, end_us);
    for (TimedDatagram& datagram : datagrams) {
      const std::uint64_t now_us = datagram.now_us;
      pose::Message message = testing::pose_at(now_us - testing::kPoseAgeUs, 2);
      message.clock_us -= testing::kStartUs + 800'000 - 5'000;
      datagram = testing::datagram_of(message);
      datagram.now_us = now_us;
    }
    return datagrams;
  };
  std::ranges::move(anew(800'000, 1'600'000), std::back_inserter(drive));
  bench.take(drive);
  EXPECT_EQ(bench.end().causes[static_cast<std::size_t>(pose::Cause::kRestart)].began.times, 1U);
  EXPECT_EQ(bench.end().packets_placed, 4U);
  for (std::size_t frame = 1; frame < bench.classes.reports.size(); ++frame) {
    const std::uint64_t elapsed_us =
        bench.classes.reports[frame].stamp_us - bench.classes.reports[frame - 1].stamp_us;
    ASSERT_LT(elapsed_us, 100'000U) << frame;
  }
  EXPECT_NEAR(static_cast<double>(bench.report().stamp_us - bench.classes.reports[20].stamp_us),
              19.0 * kPeriodUs, 20'000);
  // It fades as it should: without anything new for a while, most is unknown.
  const std::size_t known = bench.classes.cells.size();
  EXPECT_GT(known, 1000U);
  bench.take(anew(1'600'000, 2'600'000));
  EXPECT_LT(bench.classes.cells.size(), known / 2);
}

// A scanner whose clock is hours ahead is not placed and does not take the window's time with it.
TEST(PerceptionTime, AStrangeClockPlacesNothingAndMovesNoTime) {
  const Car car(tests::ThreeLux::kVehicle, true);
  PerceptionBench alone(car.vehicle());
  PerceptionBench disturbed(car.vehicle());
  constexpr std::uint64_t kHours = 7'200'000'000;
  for (int number = 1; number <= 6; ++number) {
    const std::uint64_t end_us = static_cast<std::uint64_t>(number) * kPeriodUs;
    const auto poses = testing::poses(end_us - kPeriodUs, end_us);
    const auto good = testing::scan_of_wall(100, number, 2, end_us - 5'000, 28);
    auto strange = testing::scan_of_wall(101, number, 2, end_us + kHours, 28 + 10.0 * 7200);
    for (PerceptionBench* const bench : {&alone, &disturbed}) {
      bench->take(poses);
      bench->take(good);
      if (bench == &disturbed) {
        for (TimedDatagram& datagram : strange) {
          datagram.now_us = end_us - 4'000;
        }
        bench->take(strange);
      }
      bench->pass_until(end_us + 39'000);
    }
  }
  ASSERT_EQ(alone.classes.reports.size(), disturbed.classes.reports.size());
  const std::uint64_t ahead_us = disturbed.report().stamp_us - alone.report().stamp_us;
  EXPECT_LE(ahead_us, pose::kLateUs + 40'000);
  EXPECT_EQ(disturbed.slices_by(pose::Cause::kNone), alone.slices_by(pose::Cause::kNone));
  EXPECT_GT(disturbed.slices_by(pose::Cause::kLate), 0U);
  EXPECT_FALSE(disturbed.report().is_forgotten);
}

// The only scanner's clock falls back by hours: it places nothing, and what was known fades.
TEST(PerceptionTime, AClockThatIsBehindKeepsNoTime) {
  const Car car(tests::OneLux::kVehicle, true);
  PerceptionBench bench(car.vehicle());
  constexpr std::uint64_t kHours = 7'200'000'000;
  constexpr int kLastFrame = 20 + 10 * 25;
  auto drive = drive_at_wall(20);
  std::ranges::move(testing::poses(20 * kPeriodUs, kLastFrame * kPeriodUs),
                    std::back_inserter(drive));
  for (int frame = 21; frame <= kLastFrame; ++frame) {
    const std::uint64_t end_us = static_cast<std::uint64_t>(frame) * kPeriodUs;
    for (TimedDatagram& late : testing::scan_of_wall(100, frame, 4, end_us - kHours, kWallM)) {
      late.now_us = end_us;
      drive.push_back(std::move(late));
    }
  }
  bench.take(drive);
  EXPECT_EQ(bench.end().packets_not_placed, 4U);
  EXPECT_EQ(bench.classes.cells.size(), 0U);
  EXPECT_EQ(bench.end().causes[static_cast<std::size_t>(pose::Cause::kLost)].began.times, 0U);
}

}  // namespace
}  // namespace iog::app
