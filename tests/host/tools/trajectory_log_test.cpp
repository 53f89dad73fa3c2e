// Trajectories as SLAM programs and ROS write them, and which format a log has. The quaternion is
// that of numpy's product of the matrices of heading 30, pitch 10 and roll 5 degrees.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gtest/gtest.h"

#include "fakes/temporary_folder.hpp"
#include "tools/formats/capture/made_capture.hpp"
#include "tools/formats/mcap/writer.hpp"
#include "tools/formats/ros/cdr_writer.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

using Turn = std::array<double, 4>;
using Message = std::vector<std::byte>;

constexpr Turn kTurn{0.019436667336159456, 0.0953524245505064, 0.25391661851111347,
                     0.9623182851526231};
constexpr const char* kTumRow =
    " 1e0\t2  0.5 0.019436667336159456 0.0953524245505064 0.25391661851111347 0.9623182851526231\n";
constexpr std::string_view kOdometry = "nav_msgs/msg/Odometry";
constexpr std::string_view kTransforms = "tf2_msgs/msg/TFMessage";

class Trajectories : public testing::Test {
 protected:
  std::string write(const std::string& name, std::string_view text) const {
    OutputFile file(folder_ / name);
    file.write(text);
    file.finish();
    return folder_ / name;
  }

  // Each message on each topic.
  std::string bag(std::string_view type, const std::vector<Message>& messages,
                  const std::vector<std::string>& topics = {"/odom"}) const {
    mcap::Writer writer(folder_ / "log.mcap", "ros2", mcap::Compression::kZstd);
    const auto schema =
        writer.add_schema({.name = std::string(type), .encoding = "ros2msg", .text = ""});
    for (const std::string& topic : topics) {
      const auto channel = writer.add_channel(
          {.schema_id = schema, .topic = topic, .message_encoding = "cdr", .metadata = {}});
      for (const Message& message : messages) {
        writer.write(channel, {.log_ns = 1, .publish_ns = 1}, message);
      }
    }
    writer.finish("iog", {});
    return folder_ / "log.mcap";
  }

  static void expect_error(const std::string& input, std::string_view words) {
    try {
      static_cast<void>(read_pose_log(input));
      ADD_FAILURE() << input << " is read, not: " << words;
    } catch (const UsageError& error) {
      EXPECT_NE(std::string_view(error.what()).find(words), std::string::npos) << error.what();
    }
  }

  tests::TemporaryFolder folder_;
};

void put_place(ros::CdrWriter& out, std::string_view frame, std::string_view child,
               const Turn& turn) {
  out.put(std::uint32_t{1'700'000'000});
  out.put(std::uint32_t{500'000'999});
  out.put(frame);
  out.put(child);
  for (const double value : {1.0, 2.0, 0.5, turn[0], turn[1], turn[2], turn[3]}) {
    out.put(value);
  }
}

Message odometry(double speed, const Turn& turn = kTurn, std::string_view of = "base_link",
                 std::string_view in = "odom") {
  ros::CdrWriter out;
  put_place(out, in, of, turn);
  const auto put_variances = [&out](double along, double about_z) {
    for (int i = 0; i < 36; ++i) {
      out.put(i == 0 ? along : i == 35 ? about_z : 0.0);
    }
  };
  put_variances(9, 9);
  for (const double value : {speed, 0.0, 0.0, 0.0, 0.0, speed / 100}) {
    out.put(value);
  }
  put_variances(0.0004, speed == 0 ? 0 : 1e-6);
  return out.take();
}

// geometry_msgs/msg/PoseStamped, or with covariances behind it.
Message stamped(bool has_covariance) {
  ros::CdrWriter out;
  out.put(std::uint32_t{1'700'000'000});
  out.put(std::uint32_t{500'000'999});
  out.put(std::string_view("map"));
  for (const double value : {1.0, 2.0, 0.5, kTurn[0], kTurn[1], kTurn[2], kTurn[3]}) {
    out.put(value);
  }
  for (int i = 0; has_covariance && i < 36; ++i) {
    out.put(0.5);
  }
  return out.take();
}

Message transform(std::string_view parent, std::string_view child) {
  ros::CdrWriter out;
  out.put(std::uint32_t{1});
  put_place(out, parent, child, kTurn);
  return out.take();
}

Message transforms(std::string_view parent, std::string_view vehicle = "base_link") {
  ros::CdrWriter out;
  out.put(std::uint32_t{3});
  put_place(out, "map", "odom", {0, 0, 0, 1});
  put_place(out, parent, vehicle, kTurn);
  put_place(out, "base_footprint", "base_link", {0, 0, 0, 1});
  return out.take();
}

void expect_pose(const PoseLog& log) {
  ASSERT_FALSE(log.poses.empty());
  EXPECT_EQ(log.poses[0].time_us, 1'700'000'000'500'000U);
  EXPECT_EQ(log.poses[0].x_m, 1);
  EXPECT_EQ(log.poses[0].y_m, 2);
  EXPECT_NEAR(log.poses[0].heading_rad.value_or(0), 30 * kRadians, 1e-9);
}

TEST_F(Trajectories, AByteOrderMarkIsNoPartOfANumber) {
  const std::string row = std::string("1") + kTumRow;
  const PoseLog log = read_tum_log(write("bom.tum", "\xEF\xBB\xBF" + row));
  ASSERT_EQ(log.poses.size(), 1U);
  EXPECT_EQ(log.poses[0].time_us, 1'000'000U);
}

TEST_F(Trajectories, OfTumAreReadByTheirColumns) {
  for (const char* const time : {"1700000000.500000999", "1.7000000005e+09"}) {
    const PoseLog log = read_tum_log(write("a.tum", std::string("# time\n\n") + time + kTumRow));
    expect_pose(log);
    EXPECT_FALSE(log.poses[0].sigma_m || log.poses[0].speed_mps);
    EXPECT_EQ(log.poses[0].place, 3U);
  }
  const auto expect = [this](const std::string& row, std::string_view words) {
    expect_error(write("a.tum", "1 2 3 4 0 0 0 1\n" + row), words);
  };
  expect("1 2 3 4 0 0 0", "a.tum:2: 7 numbers instead of 8");
  expect("1 2 nan 4 0 0 0 1", "a.tum:2: 'nan' is not a number");
  expect("1 2 3 4 0 0 0 0", "a.tum:2: qx qy qz qw are no");
  expect("-1 2 3 4 0 0 0 1", "a.tum:2: the time is '-1'");
}

// 30 degrees to the left is w = cos(15 degrees), z = sin(15 degrees), and w comes last.
TEST_F(Trajectories, OfTumThatHaveWFirstAreTold) {
  const auto notes_of = [this](const std::string& turn) {
    std::string rows;
    for (int i = 0; i < 9; ++i) {
      rows += "1700000000." + std::to_string(i) + " 0 0 0 " + turn + "\n";
    }
    return converted(read_tum_log(write("a.tum", rows)), {}).notes;
  };
  EXPECT_TRUE(notes_of("0 0 0.258819 0.965926").empty());
  EXPECT_EQ(notes_of("0.965926 0 0 0.258819"),
            std::vector<std::string>{"9 poses are tilted by more than 45 degrees: check that z is "
                                     "up, and that quaternions are x, y, z, w"});
}

// Right, down and forward of the camera; the unit is 0.3 m behind it, and turns to the left. The
// camera is then 5 m ahead and 2 m to the left of where it was.
TEST_F(Trajectories, OfKittiAreThoseOfTheUnit) {
  write("calib.txt", "P0: 1\nTr: 0 -1 0 0 0 0 -1 0 1 0 0 -0.3\n");
  write("times.txt", "0.000000e+00\n1.035980e-01\n");
  const std::string path =
      write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n0 0 -1 -2 0 1 0 0 1 0 0 5\n");
  for (const std::string& input : {folder_.path(), path}) {
    const PoseLog log = read_pose_log(input);
    ASSERT_EQ(log.poses.size(), 2U);
    EXPECT_TRUE(log.is_of_unit);
    EXPECT_EQ(log.poses[1].time_us, kDriveStartUs + 103'598);  // as the clouds' packets have it
    EXPECT_NEAR(log.poses[1].x_m, 5 + 0.3, 1e-9);
    EXPECT_NEAR(log.poses[1].y_m, 2 - 0.3, 1e-9);
    EXPECT_NEAR(log.poses[1].heading_rad.value_or(0), 90 * kRadians, 1e-9);
  }
  expect_error(write("poses.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n"), "1 pose, and times of 2");
  write("times.txt", "0\n\n");
  EXPECT_EQ(read_pose_log(path).poses.size(), 1U);
  write("times.txt", "");
  expect_error(path, "1 pose, and times of 0");
}

TEST_F(Trajectories, OfOdometryHaveTheErrorsOfTheirTwist) {
  const PoseLog log = read_pose_log(bag(kOdometry, {odometry(10)}));
  expect_pose(log);
  EXPECT_EQ(log.poses[0].speed_mps, 10);
  EXPECT_EQ(log.poses[0].yaw_rate_rps, 0.1);
  EXPECT_NEAR(log.poses[0].sigma_m.value_or(0), 0.02, 1e-12);
  EXPECT_NEAR(log.poses[0].sigma_heading_rad.value_or(0), 0.001, 1e-12);
  // Of a variance that nobody fills in, and before there is a heading, which converted() counts.
  const PoseLog empty = read_pose_log(bag(kOdometry, {odometry(0), odometry(0, {})}));
  ASSERT_EQ(empty.poses.size(), 2U);
  EXPECT_FALSE(empty.poses[0].sigma_heading_rad);
  EXPECT_FALSE(empty.poses[1].heading_rad);
  // A pose of what is somewhere else in the car, and one that does not say.
  EXPECT_TRUE(log.notes.empty());
  EXPECT_TRUE(read_pose_log(bag(kOdometry, {odometry(10, kTurn, "")})).notes.empty());
  EXPECT_EQ(read_pose_log(bag(kOdometry, {odometry(10, kTurn, "gps")})).notes,
            std::vector<std::string>{"the poses are of gps, not of base_link: --poses-mount says "
                                     "where in the car that is"});
  // Two sources on one topic.
  expect_error(bag(kOdometry, {odometry(10), odometry(10, kTurn, "base_link", "map")}),
               "the poses are in odom and in map: choose another topic");
  expect_error(bag(kOdometry, {odometry(10), odometry(10, kTurn, "trailer")}),
               "the poses are of base_link and of trailer: choose another topic");
  Message cut = odometry(10);
  cut.resize(300);
  expect_error(bag(kOdometry, {cut}), "cut off");
}

TEST_F(Trajectories, OfTransformsAreThoseOfTheCar) {
  const PoseLog log = read_pose_log(bag(kTransforms, {transforms("odom")}));
  EXPECT_EQ(log.poses.size(), 1U);
  expect_pose(log);
  const PoseLog of_footprint =
      read_pose_log(bag(kTransforms, {transforms("odom", "base_footprint")}));
  EXPECT_EQ(of_footprint.poses.size(), 1U);
  expect_pose(of_footprint);
  const Message below = transforms("base_link", "base_footprint");
  EXPECT_EQ(read_pose_log(bag(kTransforms, {transforms("odom"), below})).poses.size(), 1U);
  expect_error(bag(kTransforms, {transforms("odom"), transforms("map")}),
               "the vehicle is in odom and in map");
}

// Frames may stand between the two of the vehicle, and messages come in any order.
TEST_F(Trajectories, OfTransformsBelowAFootprintOneMoves) {
  std::vector<Message> chain{transform("odom", "base_footprint"),
                             transform("base_footprint", "base_stabilized"),
                             transform("base_stabilized", "base_link")};
  std::ranges::sort(chain);
  do {
    std::vector<Message> all = chain;
    all.insert(all.end(), chain.begin(), chain.end());
    const PoseLog log = read_pose_log(bag(kTransforms, all));
    EXPECT_LE(log.poses.size(), 2U);
    expect_pose(log);
  } while (std::ranges::next_permutation(chain).found);
}

// As robots with a namespace name their frames.
TEST_F(Trajectories, OfTransformsMayHaveANamespace) {
  const Message one = transforms("odom", "one/base_link");
  const PoseLog log = read_pose_log(bag(kTransforms, {one}));
  EXPECT_EQ(log.poses.size(), 1U);
  expect_pose(log);
  const Message two = transforms("odom", "two/base_footprint");
  expect_error(bag(kTransforms, {one, two}),
               "in /tf several vehicles, one/base_link, two/base_footprint");
  EXPECT_EQ(read_pose_log(bag(kTransforms, {one, transforms("odom"), two})).poses.size(), 1U);
  expect_error(bag(kTransforms, {transforms("odom", "base")}),
               "no /tf of base_link or base_footprint, only of base, odom");
}

TEST_F(Trajectories, OfStampedPosesAreTakenAsTheCars) {
  for (const std::string_view type :
       {"geometry_msgs/msg/PoseStamped", "geometry_msgs/msg/PoseWithCovarianceStamped"}) {
    const bool has_covariance = type.ends_with("CovarianceStamped");
    const PoseLog log = read_pose_log(bag(type, {stamped(has_covariance)}, {"/pose"}));
    expect_pose(log);
    EXPECT_FALSE(log.poses[0].speed_mps || log.poses[0].sigma_m);
    EXPECT_EQ(log.notes, std::vector<std::string>{
                             "its stamped poses do not say of which frame they are: base_link is "
                             "assumed, and --poses-mount says where in the car another one is"});
    expect_error(bag(type, {stamped(has_covariance)}, {"/pose", "/goal_pose"}),
                 "/pose and /goal_pose have poses: choose one by");
  }
  expect_error(bag("nav_msgs/msg/Path", {stamped(false)}, {"/path"}),
               "its topics are /path (nav_msgs/msg/Path); `iog odometry` estimates poses from a "
               "spinning lidar");
}

// A logger that lost its power.
TEST_F(Trajectories, OfAFileWithoutItsEndAreUsed) {
  const std::string path = bag(kOdometry, std::vector<Message>(9, odometry(10)));
  std::filesystem::resize_file(path, std::filesystem::file_size(path) - 8);
  const PoseLog log = read_pose_log(path);
  EXPECT_EQ(log.poses.size(), 9U);
  EXPECT_TRUE(log.remarks.empty());
  EXPECT_EQ(log.notes, std::vector<std::string>{path + ": its end is missing; it was read up to "
                                                       "there"});
}

TEST_F(Trajectories, OneOfSeveralTopicsIsChosen) {
  const std::string path = bag(kOdometry, {odometry(10)}, {"/gps", "/odom"});
  expect_error(path, "/gps and /odom have poses: choose one by");
  EXPECT_EQ(read_pose_log(path + ":/odom").poses.size(), 1U);
  expect_error(path + ":/imu",
               "on /imu; its topics of these types are /gps (nav_msgs/msg/Odometry), /odom (");
  EXPECT_EQ(
      read_pose_log(bag(kTransforms, {transforms("odom")}, {"/tf", "/map"}) + ":/tf").poses.size(),
      1U);
  expect_error(bag(kTransforms, {transforms("odom")}, {"/tf"}) + ":/odom",
               "are /tf (tf2_msgs/msg/TFMessage)");
}

TEST_F(Trajectories, TheFirstBytesShowTheFormat) {
  expect_pose(read_pose_log(write("1", "#\n1700000000.5" + std::string(kTumRow))));
  expect_pose(read_pose_log(write("2", "# time_s,x_m,y_m,heading_deg\n1700000000.5,1,2,30\n")));
  EXPECT_FALSE(read_pose_log(write("3", "$GPRMC,,V,,,,,,,,,,N*53\r\n")).remarks.empty());
  expect_error(write("empty", ""), "empty: empty");
  expect_error(write("5", "1 2 3 4\n"), "no log of poses that is read");
  expect_error(folder_.path(), "no log of poses that is read");
}

}  // namespace
}  // namespace iog::tools
