#include "tools/odometry/drive_motion.hpp"

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/pcap_writer.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/simulate/drives/drive.hpp"

namespace iog::tools {
namespace {

constexpr double kDegree = 3.14159265358979323846 / 180;

// Ten metres a second along a circle, by 20 degrees a second, seen ten times a second.
std::vector<TurnPose> circle(std::size_t count) {
  constexpr double kRadiusM = 10 / (20 * kDegree);
  std::vector<TurnPose> turns;
  for (std::size_t i = 0; i < count; ++i) {
    const double heading = 2 * kDegree * static_cast<double>(i);
    TurnPose turn{.time_us = 1'700'000'000'000'000 + i * 100'000};
    turn.pose = Pose(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ()));
    turn.pose.translation() =
        Eigen::Vector3d(kRadiusM * std::sin(heading), kRadiusM * (1 - std::cos(heading)), 0);
    turns.push_back(turn);
  }
  return turns;
}

PoseLog log_of(const std::vector<TurnPose>& turns) {
  const tests::TemporaryFolder folder;
  OutputFile file(folder / "poses.csv");
  file.write(csv_of(turns));
  file.finish();
  return read_pose_log(folder / "poses.csv");
}

TEST(DriveMotion, IsALogThatIsRead) {
  const PoseLog log = log_of(circle(31));
  ASSERT_EQ(log.poses.size(), 156U);  // from a turn before the first on
  EXPECT_TRUE(log.remarks.empty());
  for (std::size_t i = 0; i < log.poses.size(); ++i) {
    const LoggedPose& pose = log.poses[i];
    const double heading = 0.4 * kDegree * (static_cast<double>(i) - 5);
    EXPECT_EQ(pose.time_us, 1'699'999'999'900'000 + i * 20'000);
    EXPECT_NEAR(std::remainder(*pose.heading_rad - heading, 360 * kDegree), 0, 1e-5);
    // Between turns it moves along the chord, which is 4 mm off the circle.
    EXPECT_NEAR(pose.x_m, 10 / (20 * kDegree) * std::sin(heading), 0.01);
    EXPECT_NEAR(*pose.speed_mps, 10, 0.05);
    EXPECT_NEAR(*pose.yaw_rate_rps, 20 * kDegree, 1e-4);
  }
}

// The target takes 150 mm at most.
TEST(DriveMotion, SigmaGrowsWithTheWayAndWhereNothingIsSure) {
  std::vector<TurnPose> turns = circle(40);
  const double moving = sigma_at(turns, 39).position_m;
  EXPECT_LT(moving, 0.15);
  std::vector<TurnPose> standing = turns;
  for (TurnPose& turn : standing) {
    turn.pose = Pose::Identity();
  }
  EXPECT_LT(sigma_at(standing, 39).position_m, moving);
  turns[20].is_sure = false;
  for (std::size_t i = 0; i < turns.size(); ++i) {
    EXPECT_EQ(sigma_at(turns, i).position_m >= 1, i >= 20 && i < 30) << i;
  }
  EXPECT_NE(words_of(turns).find("in 1 turn, the first after 2.0 s"), std::string::npos);
}

std::string refusal_of(const std::vector<CapturedDatagram>& datagrams, const std::string& car) {
  const tests::TemporaryFolder folder;
  PcapWriter writer(folder / "drive.pcap");
  for (const CapturedDatagram& datagram : datagrams) {
    writer.write(datagram);
  }
  writer.finish();
  try {
    static_cast<void>(motion_in({folder / "drive.pcap"}, find_vehicle(car)));
  } catch (const UsageError& error) {
    return error.what();
  }
  return "";
}

TEST(DriveMotion, WhatHasNoTurnsIsRefused) {
  EXPECT_EQ(refusal_of({}, "reference_car"),
            "reference_car has no spinning lidar, and the motion is estimated from its turns");
  EXPECT_TRUE(refusal_of({}, "roof_vlp16")
                  .ends_with("drive.pcap: 0 whole turns of a spinning lidar of roof_vlp16, and a "
                             "motion needs two"));
}

// Of a drive of a second: one turn, and a capture whose times stand still.
TEST(DriveMotion, OneTurnIsRefused) {
  const CatalogueEntry& car = find_vehicle("roof_vlp16");
  Drive drive(car, 1, 1, find_scene("street"), Motion::kContinuous);
  std::vector<CapturedDatagram> datagrams;
  for (std::uint32_t frame = 0; frame < 3; ++frame) {
    for (const CapturedDatagram& datagram : drive.datagrams(frame)) {
      datagrams.push_back(datagram);
      datagrams.back().time_us = 1'700'000'000'000'000;
    }
  }
  const std::string one = "1 whole turn of a spinning lidar of roof_vlp16, and a motion needs two";
  EXPECT_TRUE(refusal_of(datagrams, "roof_vlp16").ends_with(one));
}

}  // namespace
}  // namespace iog::tools
