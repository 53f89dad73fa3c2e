// Motions that are known, in worlds whose scans are computed here.
#include "tools/odometry/odometry.hpp"

#include <optional>
#include <vector>

#include "gtest/gtest.h"

#include "tools/odometry/drive_motion.hpp"
#include "tools/odometry/lidar_world.hpp"

namespace iog::tools {
namespace {

Path straight(double speed_mps) {
  return [=](double seconds) { return TruePose{speed_mps * seconds, 0, 0}; };
}

std::vector<TurnPose> drive(const Boxes& boxes, const Path& path, std::uint64_t turns,
                            std::optional<double> likely_mps = std::nullopt) {
  Odometry odometry;
  std::vector<TurnPose> found;
  for (std::uint64_t i = 1; i <= turns; ++i) {
    found.push_back(odometry.add(turn_at(boxes, path, i), likely_mps));
  }
  return found;
}

// The goal of two recorded drives: 2 % of the way, and 1 degree.
void expect_path(const std::vector<TurnPose>& found, const Path& path) {
  const TruePose first = path(1e-6 * kTurnUs);
  const TruePose last = path(1e-6 * static_cast<double>(found.size() * kTurnUs));
  const double x = last.x_m - first.x_m;
  const double y = last.y_m - first.y_m;
  const double cos = std::cos(first.heading_rad);
  const double sin = std::sin(first.heading_rad);
  const Pose& end = found.back().pose;
  const double most_m = 0.05 + 0.02 * std::hypot(x, y);
  EXPECT_NEAR(end.translation().x(), cos * x + sin * y, most_m);
  EXPECT_NEAR(end.translation().y(), cos * y - sin * x, most_m);
  EXPECT_NEAR(heading_rad(end), last.heading_rad - first.heading_rad, kTestDegree);
  for (const TurnPose& turn : found) {
    EXPECT_TRUE(turn.is_sure) << turn.time_us;
  }
}

TEST(Odometry, FollowsACarFromAnySpeed) {
  for (const double speed : {0.0, 7.0, 14.0, 27.0}) {
    SCOPED_TRACE(speed);
    expect_path(drive(street(), straight(speed), 12), straight(speed));
  }
}

// Poses may be wrong: only the scans decide.
TEST(Odometry, FindsTheSpeedWhateverIsLikely) {
  for (const double likely : {0.0, 12.0, 14.0, 17.0, 40.0, -14.0}) {
    SCOPED_TRACE(likely);
    expect_path(drive(street(), straight(14), 4, likely), straight(14));
  }
}

// Brakes, gains speed and swerves by 12 degrees: the heading is that of the path.
TEST(Odometry, FollowsACarThatSwerves) {
  const Path path = [](double seconds) {
    const double x = 6 * seconds - 3 * std::cos(seconds);
    return TruePose{x, 1.5 * std::sin(x / 7), std::atan(1.5 / 7 * std::cos(x / 7))};
  };
  expect_path(drive(street(), path, 40), path);
}

TEST(Odometry, AStandingCarStands) {
  for (const TurnPose& turn : drive(street(), straight(0), 15)) {
    EXPECT_LT(turn.pose.translation().head<2>().norm(), 0.05);
    EXPECT_LT(std::abs(heading_rad(turn.pose)), 0.1 * kTestDegree);
  }
}

// Any motion along the surfaces gives the same scans.
TEST(Odometry, APlainAndATunnelDoNotDetermineTheMotion) {
  for (const Boxes& boxes : {Boxes(), tunnel()}) {
    const std::vector<TurnPose> found = drive(boxes, straight(10), 12);
    for (std::size_t i = 1; i < found.size(); ++i) {
      EXPECT_FALSE(found[i].is_sure) << i;
      EXPECT_GE(sigma_at(found, i).position_m, 1) << i;
    }
  }
}

// A wardrobe: every surface is seen, and two points of a surface are no plane.
TEST(Odometry, ASmallPlaceIsSaid) {
  const Boxes walls{{1.2, 1.4, -2, 2}, {-1.4, -1.2, -2, 2}, {-2, 2, 1.2, 1.4}, {-2, 2, -1.4, -1.2}};
  const std::vector<TurnPose> found = drive(walls, straight(0), 4);
  for (std::size_t i = 1; i < found.size(); ++i) {
    EXPECT_FALSE(found[i].is_sure) << i;
  }
}

TEST(Odometry, NothingToSeeIsSaid) {
  Odometry odometry;
  for (std::uint64_t i = 1; i <= 3; ++i) {
    EXPECT_EQ(odometry.add({.end_us = kBeginUs + i * kTurnUs}).is_sure, i == 1);
  }
}

// What happened in a silence is not known, but what follows is.
TEST(Odometry, ASilenceIsSaid) {
  Odometry odometry;
  for (const std::uint64_t i : {1U, 2U, 3U, 4U, 20U, 21U, 22U}) {
    EXPECT_EQ(odometry.add(turn_at(street(), straight(10), i)).is_sure, i != 20) << i;
  }
}

TEST(Odometry, AQuarterTurnInTwoParts) {
  Pose quarter(Eigen::AngleAxisd(90 * kTestDegree, Eigen::Vector3d::UnitZ()));
  const Pose half = part_of(quarter, 0.5);
  EXPECT_NEAR(heading_rad(half), 45 * kTestDegree, 1e-12);
  EXPECT_TRUE((half * half).isApprox(quarter));
}

}  // namespace
}  // namespace iog::tools
