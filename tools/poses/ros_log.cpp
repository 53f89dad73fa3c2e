#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "tools/formats/ros/cdr_reader.hpp"
#include "tools/formats/ros/recorded_messages.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/joined.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools {
namespace {

using ros::CdrReader;

constexpr std::string_view kOdometry = "nav_msgs/msg/Odometry";
constexpr std::string_view kTransforms = "tf2_msgs/msg/TFMessage";
constexpr std::array<std::string_view, 3> kPoses{kOdometry, "geometry_msgs/msg/PoseStamped",
                                                 "geometry_msgs/msg/PoseWithCovarianceStamped"};

// Of the vehicle (REP 105), as a child of `odom` or whatever does not jump.
constexpr std::string_view kVehicleFrame = "base_link";
// Of a robot that moves this frame, in which base_link stands still (REP 120).
constexpr std::string_view kFootprint = "base_footprint";

// 2.7 hours at 200 Hz. One message of a damaged file may contain millions.
constexpr std::size_t kMostPoses = 2'000'000;

void add(const LoggedPose& pose, const std::string& where, PoseLog& log) {
  if (log.poses.size() == kMostPoses) {
    throw UsageError(where + ": more than " + std::to_string(kMostPoses) + " poses: cut the file");
  }
  log.poses.push_back(pose);
}

// A point or a vector, and a turn.
void read_place(CdrReader& in, LoggedPose& pose) {
  std::array<double, 7> numbers{};
  std::ranges::generate(numbers, [&in] { return in.f64(); });
  pose.x_m = numbers[0];
  pose.y_m = numbers[1];
  const Quaternion turn{numbers[3], numbers[4], numbers[5], numbers[6]};
  pose.heading_rad = heading_of(turn);
  pose.is_tilted = is_tilted(turn);
}

// The root of a variance that says something.
std::optional<double> sigma_of(double variance) {
  return variance > 0 && std::isfinite(variance) ? std::optional(std::sqrt(variance))
                                                 : std::nullopt;
}

// A stamped pose does not say of which frame it is.
LoggedPose pose_of(const ros::RecordedMessage& message, std::string& frame) {
  CdrReader in(message.data, message.where);
  LoggedPose pose{.time_us = in.stamp_us()};
  static_cast<void>(in.text());  // in which it is
  const bool is_odometry = message.type == kOdometry;
  frame = is_odometry ? in.text() : "";
  read_place(in, pose);
  if (!is_odometry) {
    in.must_be_whole();
    return pose;
  }
  std::array<double, 36> covariance{};  // x, y, z, about x, about y, about z
  std::ranges::generate(covariance, [&in] { return in.f64(); });  // of the place: it drifts
  std::array<double, 6> twist{};
  std::ranges::generate(twist, [&in] { return in.f64(); });
  pose.speed_mps = twist[0];
  pose.yaw_rate_rps = twist[5];
  std::ranges::generate(covariance, [&in] { return in.f64(); });
  in.must_be_whole();
  // The error of a rate is that of the way in a second.
  pose.sigma_m = sigma_of(covariance[0]);
  pose.sigma_heading_rad = sigma_of(covariance[35]);
  return pose;
}

struct Transforms {
  std::string robot{};  // whose poses are in the log: that without a name, or the first
  std::string parent{};
  bool is_one = true;
  FewNames vehicles{};
  FewNames others{};  // child frames

  void add(const ros::RecordedMessage& message, PoseLog& log);
  // Why there are no poses.
  [[nodiscard]] std::string words() const {
    return is_one ? "no /tf of " + std::string(kVehicleFrame) + " or " + std::string(kFootprint) +
                        (others.is_empty() ? "" : ", only of " + others.words())
                  : "in /tf several vehicles, " + vehicles.words();
  }
};

void Transforms::add(const ros::RecordedMessage& message, PoseLog& log) {
  CdrReader in(message.data, message.where);
  for (std::uint32_t left = in.u32(); left > 0; --left) {
    LoggedPose pose{.time_us = in.stamp_us()};
    const std::string from = in.text();
    const std::string to = in.text();
    read_place(in, pose);
    in.must_be_whole();
    const std::optional<std::string> its = robot_of(to);
    if (!its) {
      others.add(to);
    }
    if (!its || robot_of(from)) {
      continue;
    }
    vehicles.add(to);
    if (log.poses.empty() || (its->empty() && !robot.empty())) {
      log.poses.clear();
      robot = *its;
      parent = from;
      is_one = true;
    }
    if (*its != robot) {
      is_one = robot.empty();
      continue;
    }
    if (from != parent) {
      throw UsageError(std::string(message.where)
                           .append(": the vehicle is in ")
                           .append(printable(parent))
                           .append(" and in ")
                           .append(printable(from)));
    }
    tools::add(pose, message.where, log);
  }
}

}  // namespace

std::optional<std::string> robot_of(const std::string& frame) {
  const std::size_t begin = frame.rfind('/') + 1;  // 0 without one
  const std::string_view name = std::string_view(frame).substr(begin);
  return name == kVehicleFrame || name == kFootprint ? std::optional(frame.substr(0, begin))
                                                     : std::nullopt;
}

PoseLog read_ros_log(const std::string& path, const std::string& topic) {
  PoseLog log{.unit = "pose"};
  std::string its = topic;
  std::string frame;
  const auto read = [&](std::span<const std::string_view> types) {
    log.notes = ros::for_each_message(path, types, topic, [&](const auto& message) {
      its = its.empty() ? std::string(message.topic) : its;
      if (message.topic != its) {
        throw UsageError(path + ": " + printable(its) + " and " +
                         printable(std::string(message.topic)) + " have poses: choose one by " +
                         path + ':' + printable(its));
      }
      add(pose_of(message, frame), message.where, log);
    });
  };
  read(std::span(&kOdometry, 1));
  Transforms transforms;
  bool is_assumed = false;
  if (log.poses.empty()) {
    log.notes = ros::for_each_message(path, std::span(&kTransforms, 1), topic,
                                      [&](const auto& message) { transforms.add(message, log); });
  }
  if (log.poses.empty()) {
    read(kPoses);
    is_assumed = true;
  }
  if (log.poses.empty() || !transforms.is_one) {
    throw UsageError(path + ": it has no nav_msgs/Odometry, no stamped poses, and " +
                     transforms.words() + (topic.empty() ? "" : ", on " + topic) +
                     (log.notes.empty() ? "" : "; " + joined(log.notes, "; ")) +
                     "; `iog odometry` estimates poses from a spinning lidar");
  }
  if (is_assumed) {
    log.notes.emplace_back(
        "its stamped poses do not say of which frame they are: base_link is assumed, and "
        "--poses-mount says where in the car another one is");
  }
  if (!frame.empty() && !robot_of(frame)) {
    log.notes.push_back("the poses are of " + printable(frame) + ", not of " +
                        std::string(kVehicleFrame) +
                        ": --poses-mount says where in the car that is");
  }
  ros::forget_unpacked();
  for (std::size_t i = 0; i < log.poses.size(); ++i) {
    log.poses[i].place = i + 1;
  }
  return log;
}

}  // namespace iog::tools
