// Ten seconds on a circle to the left, by 10 m/s and 20 degrees a second, beside poses that are
// wrong in a known way.
#include "tools/odometry/motion_check.hpp"

#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include "gtest/gtest.h"

#include "lidar/formats.hpp"
#include "tools/poses/pose_encoder.hpp"

namespace iog::tools {
namespace {

constexpr double kRadiusM = 10 / (20 * kRadians);
constexpr std::uint64_t kDriveUs = 1'700'000'000'000'000;

double heading_at(int tenth) { return 2 * kRadians * tenth; }

std::vector<TurnPose> turns() {
  std::vector<TurnPose> turns;
  for (int i = 0; i <= 100; ++i) {
    TurnPose& turn = turns.emplace_back();
    turn.time_us = kDriveUs + static_cast<std::uint64_t>(i) * 100'000;
    turn.pose = Pose(Eigen::AngleAxisd(heading_at(i), Eigen::Vector3d::UnitZ()));
    turn.pose.translation() = Eigen::Vector3d(kRadiusM * std::sin(heading_at(i)),
                                              kRadiusM * (1 - std::cos(heading_at(i))), 0);
  }
  return turns;
}

// What is said of poses that are changed so, and of the plane's other corner.
std::string told(const std::function<void(PoseSample&)>& change, std::int64_t offset_us = 0) {
  constexpr double kTurned = 1;
  std::vector<PoseSample> poses;
  for (int i = -1; i <= 101; ++i) {
    const double heading = heading_at(i) + kTurned;
    PoseSample& pose = poses.emplace_back();
    pose.time_us = kDriveUs + static_cast<std::uint64_t>(i) * 100'000;
    pose.x_m = 500 + kRadiusM * std::sin(heading);
    pose.y_m = -kRadiusM * std::cos(heading);
    pose.heading_rad = std::remainder(heading, 2 * std::numbers::pi);
    change(pose);
  }
  return words_of(check_of(turns(), poses, offset_us));
}

void nothing(PoseSample& /*pose*/) {}

TEST(MotionCheck, IsSilentAboutRightPoses) {
  EXPECT_EQ(told(nothing), "");
  EXPECT_EQ(told([](PoseSample& pose) { pose.time_us -= 7'000'000'000; }, 7'000'000'000), "");
  EXPECT_EQ(told([](PoseSample& pose) { pose.time_us += 3'600'000'000; }), "") << "no pose";
}

// Ten minutes straight ahead, or at a standstill, by poses whose headings and places are a little
// off to alternating sides.
TEST(MotionCheck, IsSilentAboutNoise) {
  for (const double speed_mps : {0.0, 10.0}) {
    std::vector<TurnPose> turns;
    std::vector<PoseSample> poses;
    for (int i = 0; i <= 6000; ++i) {
      const double side = i / 10 % 2 == 0 ? 1 : -1;
      const double x_m = speed_mps * i / 10;
      TurnPose& turn = turns.emplace_back();
      turn.time_us = kDriveUs + static_cast<std::uint64_t>(i) * 100'000;
      turn.pose.translation() = Eigen::Vector3d(x_m + side * 0.002, 0, 0);
      poses.push_back({.time_us = turn.time_us,
                       .x_m = x_m,
                       .y_m = side * 0.1,
                       .heading_rad = side * 0.2 * kRadians});
    }
    EXPECT_EQ(words_of(check_of(turns, poses)), "") << speed_mps;
  }
}

// A jump to the side or of the heading, and a source that repeats a pose for 3 s.
TEST(MotionCheck, LeavesOutJumpsAndRepeatedPoses) {
  const auto from = [](double second, const std::function<void(PoseSample&)>& change) {
    return told([=](PoseSample& pose) {
      if (pose.time_us >= kDriveUs + static_cast<std::uint64_t>(second * 1e6)) {
        change(pose);
      }
    });
  };
  EXPECT_EQ(from(6.5, [](PoseSample& pose) { pose.x_m += 50; }), "");
  EXPECT_EQ(from(6.5, [](PoseSample& pose) { pose.heading_rad += 3; }), "");
  std::optional<PoseSample> first;
  const auto freeze = [&](PoseSample& pose) {
    if (pose.time_us >= kDriveUs + 3'050'000 && pose.time_us < kDriveUs + 6'050'000) {
      first = first ? first : pose;
      const std::uint64_t time_us = pose.time_us;
      pose = *first;
      pose.time_us = time_us;
    }
  };
  EXPECT_EQ(told(freeze), "");
  // Wrong ones are told in spite of it, and a source that always stands.
  EXPECT_EQ(told([&](PoseSample& pose) {
              freeze(pose);
              pose.heading_rad += std::numbers::pi / 2;
            }),
            "the lidar moves 90 degrees to the left of where the poses do");
  EXPECT_EQ(told([](PoseSample& pose) { pose = {.time_us = pose.time_us}; }),
            "the lidar moves 99 m and the poses 0 m");
}

CapturedDatagram pose_at(std::uint64_t time_us, PoseEncoder& encoder) {
  return encoder.datagram_of({.time_us = time_us, .sigma_m = 0.01, .sigma_heading_rad = 1e-4});
}

// An hour of 10 poses a second, and of a lidar none or one packet.
TEST(MotionWatch, KeepsPosesAroundSamples) {
  for (const char* const name : {"reference_car", "roof_vlp16"}) {
    const CatalogueEntry& car = find_vehicle(name);
    MotionWatch watch(car);
    PoseEncoder encoder;
    for (std::uint64_t i = 0; i < 36'000; ++i) {
      CapturedDatagram pose = pose_at(kDriveUs + 100'000 * i, encoder);
      pose.destination.port = car.vehicle->poses.udp_port;
      watch.take(pose);
      if (i % 10 == 5) {  // a packet without points
        CapturedDatagram packet = pose;
        packet.destination.port = car.sensors[0].udp_port;
        watch.take(packet);
      }
    }
    EXPECT_LE(watch.poses(), lidar::turns(car.sensors[0].format) ? 20 * 25 + 2 : 0) << name;
    EXPECT_GE(watch.poses(), lidar::turns(car.sensors[0].format) ? 20 * 14 : 0) << name;
  }
}

TEST(MotionCheck, TellsWrongOnes) {
  EXPECT_EQ(told([](PoseSample& pose) { pose.heading_rad += std::numbers::pi / 2; }),
            "the lidar moves 90 degrees to the left of where the poses do");
  const std::string other_side =
      "the lidar turns by 200 degrees and the poses by 200, not at the same times or to the same "
      "side";
  EXPECT_EQ(told([](PoseSample& pose) { pose.heading_rad = -pose.heading_rad; }), other_side);
  EXPECT_EQ(told([](PoseSample& pose) {
              std::swap(pose.x_m, pose.y_m);
              pose.heading_rad = std::numbers::pi / 2 - pose.heading_rad;
            }),
            other_side);
  EXPECT_EQ(told([](PoseSample& pose) { pose.heading_rad *= kRadians; }),
            "the lidar turns by 200 degrees and the poses by 9, not at the same times or to the "
            "same side");
  EXPECT_EQ(told([](PoseSample& pose) {
              pose.x_m /= 2;
              pose.y_m /= 2;
            }),
            "the lidar moves 99 m and the poses 50 m");
}

}  // namespace
}  // namespace iog::tools
