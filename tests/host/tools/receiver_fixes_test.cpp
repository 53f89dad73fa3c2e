// Headings by course. Each drive is a stated motion; what is expected are its own headings and
// speeds.
#include "tools/poses/receiver_fixes.hpp"

#include <cmath>
#include <string>

#include "gtest/gtest.h"

namespace iog::tools {
namespace {

// The speed changes evenly to that at the end of a phase; curvature is clockwise, per metre.
struct MotionPhase {
  double seconds;
  double end_mps;
  double curvature = 0;
};

struct StatedPose {
  double heading_deg;
  double speed_mps;
};

struct StatedMotion {
  std::vector<Fix> fixes;
  std::vector<StatedPose> truth;
};

StatedMotion drive_of(double begin_mps, const std::vector<MotionPhase>& phases,
                      double period_s = 0.1) {
  StatedMotion drive;
  const auto ticks = static_cast<int>(std::lround(period_s * 1000));
  double heading_deg = 75;
  double speed = begin_mps;
  int ms = 0;
  for (const MotionPhase& phase : phases) {
    const double gain = (phase.end_mps - speed) / phase.seconds / 1000;
    for (int i = 0; i < std::lround(phase.seconds * 1000); ++i, ++ms) {
      if (ms % ticks == 0) {
        drive.fixes.push_back(
            {.time_us = 1'000'000'000 + std::uint64_t{1000} * static_cast<unsigned>(ms),
             .at = {48, 11},
             .speed_mps = std::abs(speed),
             .course_deg = heading_deg + (speed < 0 ? 180 : 0),
             .place = drive.fixes.size() + 1});
        drive.truth.push_back({heading_deg, speed});
      }
      heading_deg += speed * phase.curvature / 1000 / kRadians;
      speed += gain;
    }
  }
  return drive;
}

// Each pose with a heading has its own, as far as it says so. Returns their number.
std::size_t expect_the_truth(const PoseLog& log, const StatedMotion& drive) {
  std::size_t known = 0;
  for (std::size_t i = 0; i < log.poses.size(); ++i) {
    const LoggedPose& pose = log.poses[i];
    if (!pose.heading_rad) {
      continue;
    }
    ++known;
    const double off = std::remainder(
        *pose.heading_rad - (90 - drive.truth[i].heading_deg) * kRadians, 360 * kRadians);
    EXPECT_LE(std::abs(off), pose.heading_doubt_rad + 1e-9) << "row " << i;
    if (pose.heading_doubt_rad < 0.01) {
      EXPECT_NEAR(pose.speed_mps.value_or(99), drive.truth[i].speed_mps, 1e-3) << "row " << i;
    }
  }
  return known;
}

bool says(const std::vector<std::string>& words, const std::string& what) {
  for (const std::string& word : words) {
    if (word.find(what) != std::string::npos) {
      return true;
    }
  }
  return false;
}

TEST(ReceiverFixes, AHeadingGoesOnWhenTheCarReverses) {
  struct Case {
    std::string name;
    StatedMotion drive;
    double known;  // least share of the rows
    bool is_assumed = false;
  };
  const std::vector<Case> cases{
      {"forwards, then hard in reverse", drive_of(5, {{8, 5}, {0.8, -5}, {11, -5}}), 1, true},
      {"the same, once a second", drive_of(5, {{8, 5}, {4, -5}, {11, -5}}, 1), 1, true},
      {"begins in reverse", drive_of(-3, {{5, -3}, {2, 0}, {2, 0}, {6, 12}, {5, 12}}), 1},
      {"out of a parking space from standstill",
       drive_of(0, {{3, 0}, {2, -2, 0.15}, {3, -2, 0.15}, {2, 0}, {5, 9, 0.05}, {5, 9}}), 0.8},
      {"a turn of three points, slowly at its end",
       drive_of(9, {{3, 9},
                    {3, 3},
                    {3, 3, 0.18},
                    {1, 0, 0.18},
                    {2, -2, -0.18},
                    {3, -2, -0.18},
                    {1, 0, -0.18},
                    {3, 5, 0.18},
                    {5, 9}}),
       1},
      {"a turn about, forwards", drive_of(9, {{3, 9}, {2, 4}, {6, 4, 0.18}, {5, 4}}), 1},
      {"the same, five times a second", drive_of(9, {{3, 9}, {2, 4}, {6, 4, 0.18}, {5, 4}}, 0.2),
       1},
      {"creeps into a space in reverse",
       drive_of(10, {{5, 10}, {5, 0}, {30, 0}, {2, -0.7, 0.1}, {4, -0.7, 0.1}, {2, 0}, {9, 0}}), 1},
      {"stands at lights", drive_of(10, {{5, 10}, {4, 0}, {300, 0}, {4, 10}}), 1},
      {"faster forwards than in reverse",
       drive_of(0, {{2, 0}, {2, -2}, {3, -2}, {2, 0}, {3, 5}, {9, 5}}), 0.85, true}};
  for (const Case& one : cases) {
    SCOPED_TRACE(one.name);
    const PoseLog log = log_of(one.drive.fixes, "line");
    EXPECT_GE(static_cast<double>(expect_the_truth(log, one.drive)),
              one.known * static_cast<double>(one.drive.fixes.size()));
    EXPECT_EQ(says(log.notes, "assumed"), one.is_assumed);
  }
}

TEST(ReceiverFixes, WhatACourseLeavesOpenIsLeftOut) {
  for (const double speed : {-5.1, 5.1}) {
    const StatedMotion drive = drive_of(0, {{2, 0}, {2, speed}, {5, speed}});
    const PoseLog log = log_of(drive.fixes, "line");
    EXPECT_EQ(expect_the_truth(log, drive), 0U);
    EXPECT_TRUE(says(log.remarks, "from standstill, a course does not say (first: line 25)"))
        << log.remarks.at(0);
  }
  // A silence after which the car creeps on: it may have turned about.
  StatedMotion drive = drive_of(10, {{5, 10}, {3, 0}, {3, 0}, {2, -3}, {5, -3}});
  for (std::size_t i = 100; i < drive.fixes.size(); ++i) {
    drive.fixes[i].time_us += 60'000'000;
  }
  EXPECT_NEAR(static_cast<double>(expect_the_truth(log_of(drive.fixes, "line"), drive)), 100, 1);
}

TEST(ReceiverFixes, AStatedHeadingSaysWhichWayRound) {
  // Known in the first second, in the last one, in the middle.
  for (const std::size_t known : {0U, 90U, 45U}) {
    StatedMotion drive = drive_of(-3, {{3, -3, 0.1}, {2, -1.5}, {5, -2}});
    for (std::size_t i = known; i < known + 10; ++i) {
      drive.fixes[i].heading_deg = drive.truth[i].heading_deg;
    }
    EXPECT_EQ(expect_the_truth(log_of(drive.fixes, "line"), drive), 100U) << known;
  }
}

// Positions ten times a second, speed and course once: nothing says how the car turned between.
TEST(ReceiverFixes, AFixWithoutASpeedDoesNotStand) {
  StatedMotion drive = drive_of(9, {{5, 9, 0.05}});
  for (std::size_t i = 0; i < drive.fixes.size(); ++i) {
    if (i % 10 != 0) {
      drive.fixes[i].speed_mps.reset();
      drive.fixes[i].course_deg.reset();
    }
  }
  EXPECT_EQ(expect_the_truth(log_of(drive.fixes, "line"), drive), 5U);
}

// The plane touches where the car is, not where its receiver thought to be at first.
TEST(ReceiverFixes, TheFirstPlaceMayBeAnOutlier) {
  StatedMotion drive = drive_of(10, {{5, 10}});
  drive.fixes[0].at = {0, 0};
  drive.fixes[1].at = {-1, 179};
  const PoseLog log = log_of(drive.fixes, "line");
  EXPECT_EQ(log.poses.at(2).x_m, 0);
  EXPECT_EQ(converted(log, {}).samples.size(), 48U);
}

}  // namespace
}  // namespace iog::tools
