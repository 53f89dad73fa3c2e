// Trajectories as SLAM programs and ROS write them, and which format a log has. The quaternion is
// that of numpy's product of the matrices of heading 30, pitch 10 and roll 5 degrees.
#include <cmath>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/mcap/writer.hpp"
#include "tools/formats/ros/cdr_writer.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

using Turn = std::array<double, 4>;

constexpr Turn kTurn{0.019436667336159456, 0.0953524245505064, 0.25391661851111347,
                     0.9623182851526231};
constexpr std::string_view kTumTurn =
    "0.019436667336159456 0.0953524245505064 0.25391661851111347 0.9623182851526231";
constexpr double kHeadingRad = 30 * kRadians;

class Trajectories : public testing::Test {
 protected:
  std::string write(const std::string& name, std::string_view text) const {
    OutputFile file(folder_ / name);
    file.write(text);
    file.finish();
    return folder_ / name;
  }

  std::string write_bag(const std::string& name, std::string_view type,
                        const std::vector<std::string>& topics,
                        const std::vector<std::vector<std::byte>>& messages) const {
    mcap::Writer writer(folder_ / name, "ros2", mcap::Compression::kZstd);
    const auto schema =
        writer.add_schema({.name = std::string(type), .encoding = "ros2msg", .text = ""});
    for (const std::string& topic : topics) {
      const auto channel = writer.add_channel(
          {.schema_id = schema, .topic = topic, .message_encoding = "cdr", .metadata = {}});
      for (const auto& message : messages) {
        writer.write(channel, {.log_ns = 1, .publish_ns = 1}, message);
      }
    }
    writer.finish("iog", {});
    return folder_ / name;
  }

  static std::string error_of(const std::string& input) {
    try {
      static_cast<void>(read_pose_log(input));
    } catch (const UsageError& error) {
      return error.what();
    }
    return "";
  }

  tests::TemporaryFolder folder_;
};

void put_stamp(ros::CdrWriter& out, std::string_view frame) {
  out.put(std::uint32_t{1'700'000'000});
  out.put(std::uint32_t{500'000'999});
  out.put(frame);
}

void put_place(ros::CdrWriter& out, double x, const Turn& turn) {
  for (const double value : {x, 2.0, 0.5, turn[0], turn[1], turn[2], turn[3]}) {
    out.put(value);
  }
}

void put_variances(ros::CdrWriter& out, double along, double about_z) {
  for (int i = 0; i < 36; ++i) {
    out.put(i == 0 ? along : i == 35 ? about_z : 0.0);
  }
}

std::vector<std::byte> odometry(double speed, const Turn& turn = kTurn) {
  ros::CdrWriter out;
  put_stamp(out, "odom");
  out.put(std::string_view("base_link"));
  put_place(out, 1, turn);
  put_variances(out, 9, 9);
  for (const double value : {speed, 0.0, 0.0, 0.0, 0.0, speed / 100}) {
    out.put(value);
  }
  put_variances(out, 0.0004, speed == 0 ? 0 : 1e-6);
  return out.take();
}

std::vector<std::byte> transforms(std::string_view parent) {
  ros::CdrWriter out;
  out.put(std::uint32_t{2});
  put_stamp(out, "map");
  out.put(std::string_view("odom"));
  put_place(out, 99, kTurn);
  put_stamp(out, parent);
  out.put(std::string_view("base_link"));
  put_place(out, 1, kTurn);
  return out.take();
}

void expect_pose(const PoseLog& log) {
  ASSERT_FALSE(log.poses.empty());
  const LoggedPose& pose = log.poses[0];
  EXPECT_EQ(pose.time_us, 1'700'000'000'500'000U);
  EXPECT_EQ(pose.x_m, 1);
  EXPECT_EQ(pose.y_m, 2);
  EXPECT_NEAR(pose.heading_rad.value_or(0), kHeadingRad, 1e-9);
}

TEST_F(Trajectories, OfTumAreReadByTheirColumns) {
  const std::string row = "1700000000.500000999 1 2 0.5 " + std::string(kTumTurn) + '\n';
  const PoseLog log = read_tum_log(write("a.tum", "# timestamp tx ty tz\n\n" + row));
  expect_pose(log);
  EXPECT_FALSE(log.poses[0].sigma_m || log.poses[0].speed_mps || log.is_of_unit);
  EXPECT_EQ(log.poses[0].place, 3U);
  expect_pose(
      read_tum_log(write("b.tum", "1.7000000005e+09\t1e0 2  0.5 " + std::string(kTumTurn))));
}

TEST_F(Trajectories, AWrongRowIsToldWithItsLine) {
  const auto error = [this](const std::string& row) {
    return error_of(write("a.tum", "1 2 3 4 0 0 0 1\n" + row));
  };
  EXPECT_NE(error("1 2 3 4 0 0 0").find("a.tum:2: 7 numbers instead of 8"), std::string::npos);
  EXPECT_NE(error("1 2 nan 4 0 0 0 1").find("a.tum:2: 'nan' is no number"), std::string::npos);
  EXPECT_NE(error("1 2 3 4 0 0 0 0").find("a.tum:2: qx qy qz qw are no"), std::string::npos);
  EXPECT_NE(error("-1 2 3 4 0 0 0 1").find("a.tum:2: the time is '-1'"), std::string::npos);
}

// Right, down and forward of the camera; the unit is 0.3 m behind it, and turns to the left.
TEST_F(Trajectories, OfKittiAreThoseOfTheUnit) {
  write("calib.txt", "P0: 1\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n");
  write("times.txt", "0.000000e+00\n1.035980e-01\n");
  const std::string path =
      write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 -1 -2 0 1 0 0 1 0 0 5\n");
  for (const std::string& input : {folder_.path(), path}) {
    const PoseLog log = read_pose_log(input);
    ASSERT_EQ(log.poses.size(), 2U);
    EXPECT_TRUE(log.is_of_unit);
    EXPECT_EQ(log.poses[1].time_us, 103'598U);
    // The camera is 5 m ahead and 2 m to the left of where it was, the unit 0.3 m to its right.
    EXPECT_NEAR(log.poses[1].x_m, 5 + 0.3, 1e-9);
    EXPECT_NEAR(log.poses[1].y_m, 2 - 0.3, 1e-9);
    EXPECT_NEAR(log.poses[1].heading_rad.value_or(0), 90 * kRadians, 1e-9);
  }
  write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  EXPECT_NE(error_of(path).find("1 poses, and times of 2"), std::string::npos);
}

TEST_F(Trajectories, OfOdometryHaveTheErrorsOfTheirTwist) {
  const PoseLog log =
      read_pose_log(write_bag("a.mcap", "nav_msgs/msg/Odometry", {"/odom"}, {odometry(10)}));
  expect_pose(log);
  EXPECT_EQ(log.poses[0].speed_mps, 10);
  EXPECT_EQ(log.poses[0].yaw_rate_rps, 0.1);
  EXPECT_NEAR(log.poses[0].sigma_m.value_or(0), 0.02, 1e-12);
  EXPECT_NEAR(log.poses[0].sigma_heading_rad.value_or(0), 0.001, 1e-12);
}

TEST_F(Trajectories, ATwistThatNobodyFillsInSaysNothing) {
  const PoseLog log = read_pose_log(write_bag("a.mcap", "nav_msgs/msg/Odometry", {"/odom"},
                                              {odometry(0), odometry(0, {0, 0, 0, 0})}));
  ASSERT_EQ(log.poses.size(), 2U);
  EXPECT_FALSE(log.poses[0].speed_mps || log.poses[0].yaw_rate_rps);
  EXPECT_FALSE(log.poses[0].sigma_heading_rad);
  EXPECT_FALSE(log.poses[1].heading_rad);  // which converted() counts
}

TEST_F(Trajectories, OfTransformsAreThoseOfTheCar) {
  constexpr std::string_view kType = "tf2_msgs/msg/TFMessage";
  const PoseLog log = read_pose_log(write_bag("a.mcap", kType, {"/tf"}, {transforms("odom")}));
  EXPECT_EQ(log.poses.size(), 1U);
  expect_pose(log);
  EXPECT_NE(error_of(write_bag("b.mcap", kType, {"/tf"}, {transforms("odom"), transforms("map")}))
                .find("base_link is in odom and in map"),
            std::string::npos);
}

TEST_F(Trajectories, OneOfSeveralTopicsIsChosen) {
  const std::string path =
      write_bag("a.mcap", "nav_msgs/msg/Odometry", {"/gps", "/odom"}, {odometry(10)});
  EXPECT_NE(error_of(path).find("/gps and /odom have poses: choose one by"), std::string::npos);
  EXPECT_EQ(read_pose_log(path + ":/odom").poses.size(), 1U);
  EXPECT_NE(error_of(path + ":/imu").find("no nav_msgs/Odometry"), std::string::npos);
  auto cut = odometry(10);
  cut.resize(300);
  EXPECT_NE(
      error_of(write_bag("b.mcap", "nav_msgs/msg/Odometry", {"/odom"}, {cut})).find("cut off"),
      std::string::npos);
}

TEST_F(Trajectories, TheFirstBytesShowTheFormat) {
  EXPECT_EQ(read_pose_log(write("1.txt", "# time_s,x_m,y_m,heading_deg\n1,2,3,4\n")).poses.size(),
            1U);
  EXPECT_EQ(read_pose_log(write("2.txt", "# of evo\n1 2 3 4 0 0 0 1\n")).poses.size(), 1U);
  EXPECT_FALSE(read_pose_log(write("3.log", "$GPRMC,,V,,,,,,,,,,N*53\r\n")).remarks.empty());
  EXPECT_NE(error_of(write("empty", "")).find("empty: empty"), std::string::npos);
  EXPECT_NE(error_of(write("4.txt", "1 2 3 4\n")).find("no log of poses that is known"),
            std::string::npos);
  EXPECT_NE(error_of(folder_.path()).find("no log of poses that is known"), std::string::npos);
}

}  // namespace
}  // namespace iog::tools
