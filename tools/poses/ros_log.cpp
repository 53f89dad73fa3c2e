#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <span>
#include <vector>

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

// what: such as "poses are". in: such as " in ".
[[nodiscard]] UsageError several_frames(const std::string& where, std::string_view what,
                                        std::string_view in, const std::string& one,
                                        const std::string& other) {
  std::string words = where + ": the ";
  words.append(what).append(in).append(printable(one)).append(" and").append(in);
  return UsageError(words + printable(other) + ": choose another topic by FILE:/topic");
}

// The frames of all poses of a topic. `of` is empty if the poses do not say of which frame they
// are.
struct PoseFrames {
  std::string in;  // such as odom
  std::string of;  // such as base_link
};

LoggedPose pose_of(const ros::RecordedMessage& message, std::optional<PoseFrames>& frames) {
  CdrReader in(message.data, message.where);
  LoggedPose pose{.time_us = in.stamp_us()};
  PoseFrames its{.in = in.text(), .of = {}};
  const bool is_odometry = message.type == kOdometry;
  its.of = is_odometry ? in.text() : "";
  if (frames && frames->in != its.in) {
    throw several_frames(message.where, "poses are", " in ", frames->in, its.in);
  }
  if (frames && frames->of != its.of) {
    throw several_frames(message.where, "poses are", " of ", frames->of, its.of);
  }
  frames = its;
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
  std::string other{};  // a second parent, unless a later message shows that it is in the vehicle
  std::string where_other{};
  bool is_one = true;
  FewNames vehicles{};
  FewNames others{};                             // child frames
  std::map<std::string, std::string> parents{};  // by child

  void add(const ros::RecordedMessage& message, PoseLog& log);
  // UsageError if the vehicle's frame has moved in two frames.
  void demand_one_parent() const {
    if (!other.empty() && !is_in_vehicle(other)) {
      throw several_frames(where_other, "vehicle is", " in ", parent, other);
    }
  }
  // Why there are no poses.
  [[nodiscard]] std::string words() const {
    return is_one ? "no /tf of " + std::string(kVehicleFrame) + " or " + std::string(kFootprint) +
                        (others.is_empty() ? "" : ", only of " + others.words())
                  : "in /tf several vehicles, " + vehicles.words();
  }

 private:
  struct Transform {
    LoggedPose pose;
    std::string from;
    std::string to;
  };
  void add(const Transform& transform, const std::string& where, PoseLog& log);
  // Whether this frame or one above it is the vehicle's.
  [[nodiscard]] bool is_in_vehicle(std::string frame) const;
};

void Transforms::add(const ros::RecordedMessage& message, PoseLog& log) {
  constexpr std::size_t kMostFrames = 10'000;
  CdrReader in(message.data, message.where);
  std::vector<Transform> transforms;
  for (std::uint32_t left = in.u32(); left > 0; --left) {
    Transform its{{.time_us = in.stamp_us()}, in.text(), in.text()};
    read_place(in, its.pose);
    in.must_be_whole();
    if (parents.size() < kMostFrames) {
      parents.insert_or_assign(its.to, its.from);
    }
    transforms.push_back(std::move(its));
  }
  for (const Transform& its : transforms) {
    add(its, message.where, log);
  }
}

void Transforms::add(const Transform& transform, const std::string& where, PoseLog& log) {
  const auto& [pose, from, to] = transform;
  const std::optional<std::string> its = robot_of(to);
  if (!its) {
    others.add(to);
  }
  if (!its || is_in_vehicle(from)) {
    return;
  }
  vehicles.add(to);
  // What is above the vehicle's frame may be known only later.
  if (log.poses.empty() || (its->empty() && !robot.empty()) || is_in_vehicle(parent)) {
    log.poses.clear();
    robot = *its;
    parent = from;
    other.clear();
    is_one = true;
  }
  if (*its != robot) {
    is_one = robot.empty();
    return;
  }
  if (from != parent) {
    if (other.empty() || is_in_vehicle(other)) {
      other = from;
      where_other = where;
    }
    return;
  }
  tools::add(pose, where, log);
}

bool Transforms::is_in_vehicle(std::string frame) const {
  constexpr int kDeepest = 32;
  for (int i = 0; i < kDeepest && !robot_of(frame); ++i) {
    const auto above = parents.find(frame);
    if (above == parents.end()) {
      return false;
    }
    frame = above->second;
  }
  return robot_of(frame).has_value();
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
  std::optional<PoseFrames> frames;
  const auto read = [&](std::span<const std::string_view> types) {
    log.notes = ros::for_each_message(path, types, topic, [&](const auto& message) {
      its = its.empty() ? std::string(message.topic) : its;
      if (message.topic != its) {
        throw UsageError(path + ": " + printable(its) + " and " +
                         printable(std::string(message.topic)) + " have poses: choose one by " +
                         path + ':' + printable(its));
      }
      add(pose_of(message, frames), message.where, log);
    });
  };
  read(std::span(&kOdometry, 1));
  Transforms transforms;
  bool is_assumed = false;
  if (log.poses.empty()) {
    log.notes = ros::for_each_message(path, std::span(&kTransforms, 1), topic,
                                      [&](const auto& message) { transforms.add(message, log); });
    transforms.demand_one_parent();
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
  if (frames && !frames->of.empty() && !robot_of(frames->of)) {
    log.notes.push_back("the poses are of " + printable(frames->of) + ", not of " +
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
