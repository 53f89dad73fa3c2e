// Clocks that differ by a known time, beside motions that are known.
#include "tools/odometry/motion_offset.hpp"

#include <cmath>
#include <functional>
#include <vector>

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

constexpr double kBeginS = 1'700'000'000;

// Speed and yaw rate at a time.
struct Rates {
  std::function<double(double)> mps;
  std::function<double(double)> rps;
};

// Sums in steps of a millisecond.
template <typename Visit>
void drive(const Rates& rates, double seconds, const Visit& visit) {
  double x = 0;
  double y = 0;
  double heading = 0;
  for (int ms = 0; ms <= seconds * 1000; ++ms) {
    const double at = ms / 1000.0;
    visit(ms, x, y, heading);
    x += rates.mps(at) / 1000 * std::cos(heading);
    y += rates.mps(at) / 1000 * std::sin(heading);
    heading += rates.rps(at) / 1000;
  }
}

std::uint64_t time_us(double seconds) {
  return static_cast<std::uint64_t>(std::llround((kBeginS + seconds) * 1e6));
}

std::vector<TurnPose> seen(const Rates& rates, double seconds) {
  std::vector<TurnPose> turns;
  drive(rates, seconds, [&](int ms, double x, double y, double heading) {
    if (ms % 100 == 0) {
      TurnPose turn{.time_us = time_us(ms / 1000.0)};
      turn.pose = Pose(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
      turn.pose.translation() = Eigen::Vector3d(x + 0.01 * (ms % 700 == 0), y, 0);
      turns.push_back(turn);
    }
  });
  return turns;
}

// By a clock that is behind, every so many milliseconds.
std::vector<PoseSample> logged(const Rates& rates, double seconds, double behind_s, int every_ms) {
  std::vector<PoseSample> poses;
  drive(rates, seconds, [&](int ms, double x, double y, double heading) {
    if (ms % every_ms == 0) {
      poses.push_back({.time_us = time_us(ms / 1000.0 - behind_s),
                       .x_m = x,
                       .y_m = y,
                       .heading_rad = std::remainder(heading, 6.283185307179586),
                       .speed_mps = rates.mps(ms / 1000.0),
                       .yaw_rate_rps = rates.rps(ms / 1000.0)});
    }
  });
  return poses;
}

double none(double) { return 0; }
double even(double) { return 9; }
// Two bends of a road, and once a brake: nothing of it repeats itself.
double bends(double at) {
  return 0.3 * std::exp(-(at - 6) * (at - 6)) - 0.2 * std::exp(-(at - 11) * (at - 11) / 4);
}
double brakes(double at) { return 9 - 5 * std::exp(-(at - 8) * (at - 8) / 6); }

TEST(MotionOffset, IsFoundByTurnsOrBySpeed) {
  for (const Rates& rates : {Rates{even, bends}, Rates{brakes, none}, Rates{brakes, bends}}) {
    for (const double behind_s : {0.0, 0.1, -0.1, 0.5, -0.5, 3.0, -3.0, 37.0, -3600.0}) {
      for (const int every_ms : {10, 100, 200}) {
        const MotionOffset found =
            offset_by_motion(seen(rates, 16), logged(rates, 16, behind_s, every_ms));
        EXPECT_EQ(found.refusal, "") << behind_s;
        EXPECT_NEAR(found.seconds, behind_s, 0.02) << every_ms;
        EXPECT_LE(std::abs(found.seconds - behind_s), 3 * found.sigma_s + 0.002) << every_ms;
      }
    }
  }
}

TEST(MotionOffset, OfAnEvenOrStandingCarIsRefused) {
  for (const Rates& rates : {Rates{even, none}, Rates{none, none}}) {
    const MotionOffset found = offset_by_motion(seen(rates, 16), logged(rates, 16, 0.5, 10));
    EXPECT_EQ(found.refusal, "the car drives too straight and evenly to show a clock offset");
  }
}

// A slalom of which each gate looks like the next.
TEST(MotionOffset, OfAMotionThatRepeatsItselfIsRefused) {
  const Rates slalom{even, [](double at) { return 0.3 * std::sin(2 * at); }};
  const MotionOffset found = offset_by_motion(seen(slalom, 30), logged(slalom, 60, 10, 10));
  EXPECT_EQ(found.refusal, "the motion repeats itself, so that several clock offsets fit");
}

TEST(MotionOffset, OfTooFewTurnsIsRefused) {
  const Rates rates{brakes, bends};
  std::vector<TurnPose> turns = seen(rates, 16);
  for (TurnPose& turn : turns) {
    turn.is_sure = false;
  }
  EXPECT_EQ(offset_by_motion(turns, logged(rates, 16, 0, 10)).refusal,
            "too few turns of the lidar determine the motion");
}

// A year between two poses is no drive, and would be a table of a year.
TEST(MotionOffset, OfALogOfDaysIsRefused) {
  const Rates rates{brakes, bends};
  std::vector<PoseSample> poses = logged(rates, 16, 0, 100);
  poses.front().time_us -= 365 * 86'400'000'000ULL;
  EXPECT_EQ(offset_by_motion(seen(rates, 16), poses).refusal,
            "the log of poses spans more than 6 hours");
}

// A recorder whose clock was set while it recorded.
TEST(MotionOffset, OfACaptureWhoseClockStepsIsRefused) {
  const Rates rates{brakes, bends};
  std::vector<TurnPose> turns = seen(rates, 16);
  for (std::size_t i = 0; i < 40; ++i) {
    turns[i].time_us -= 1'699'999'000'000'000ULL;
  }
  EXPECT_EQ(offset_by_motion(turns, logged(rates, 16, 0, 100)).refusal,
            "the capture spans more than 6 hours: a clock in it steps by 1699999000 s, so cut the "
            "capture there");
}

}  // namespace
}  // namespace iog::tools
