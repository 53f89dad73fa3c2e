#include "tools/info/static_frames.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iomanip>
#include <sstream>
#include <utility>

#include "tools/formats/ros/cdr_reader.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kMostFrames = 1000;
constexpr std::size_t kMostSteps = 32;  // from a sensor to its vehicle; frames may form a loop

// Of a quaternion x, y, z, w.
Rigid rigid_of(const std::array<double, 7>& place) {
  const auto [tx, ty, tz, x, y, z, w] = place;
  const double n = 2 / (x * x + y * y + z * z + w * w);
  return {1 - n * (y * y + z * z), n * (x * y - z * w),     n * (x * z + y * w),     tx,
          n * (x * y + z * w),     1 - n * (x * x + z * z), n * (y * z - x * w),     ty,
          n * (x * z - y * w),     n * (y * z + x * w),     1 - n * (x * x + y * y), tz};
}

// Rz(yaw) Ry(pitch) Rx(roll), as tools/car/mount.hpp turns; less than 0.005 is nothing.
std::string mount_words(const Rigid& r) {
  const auto metres = [&r](std::size_t i) { return std::abs(r[i]) < 0.005 ? 0 : r[i]; };
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "    mount = { x_m = " << metres(3)
       << ", y_m = " << metres(7) << ", z_m = " << metres(11);
  const std::array angles{std::pair("yaw", std::atan2(r[4], r[0])),
                          std::pair("pitch", std::atan2(-r[8], std::hypot(r[9], r[10]))),
                          std::pair("roll", std::atan2(r[9], r[10]))};
  for (const auto& [name, radians] : angles) {
    if (std::abs(radians / kRadians) >= 0.005) {
      text << ", " << name << "_deg = " << radians / kRadians;
    }
  }
  return text.str() + " }";
}

// ROS 1 allowed a slash before a frame's name, and tf2 does not.
std::string without_slash(std::string frame) {
  frame.erase(0, frame.starts_with('/') ? 1 : 0);
  return frame;
}

}  // namespace

void StaticFrames::add(const ros::RecordedMessage& message) {
  const bool is_static = message.topic.ends_with("/tf_static");
  ros::CdrReader in(message.data, message.where);
  for (std::uint32_t left = in.u32(); left > 0; --left) {
    static_cast<void>(in.stamp_us());
    const std::string parent = without_slash(in.text());
    const std::string child = without_slash(in.text());
    std::array<double, 7> numbers{};
    std::ranges::generate(numbers, [&in] { return in.f64(); });
    in.must_be_whole();
    const Place place{.parent = parent, .in_parent = rigid_of(numbers), .is_static = is_static};
    if (frames_.size() >= kMostFrames ||
        !std::ranges::all_of(place.in_parent, [](double each) { return std::isfinite(each); })) {
      continue;
    }
    Place& its = frames_.try_emplace(child, place).first->second;
    if (is_static) {
      its = place;
    } else if (!its.is_static) {
      its.moves = its.moves || its.parent != parent || its.in_parent != place.in_parent;
    }
  }
}

// From the frame to the root; empty if there is none.
std::vector<StaticFrames::Step> StaticFrames::steps_from(const std::string& frame) const {
  std::vector<Step> steps{{.frame = frame}};
  while (steps.size() < kMostSteps) {
    const Step& last = steps.back();
    const auto place = frames_.find(last.frame);
    if (place == frames_.end() || place->second.moves) {
      return steps;
    }
    steps.push_back({.frame = place->second.parent,
                     .first_in_it = product(place->second.in_parent, last.first_in_it),
                     .is_static = last.is_static && place->second.is_static});
  }
  return {};
}

std::optional<StaticFrames::Step> StaticFrames::above(const std::vector<Step>& steps) {
  std::optional<Step> vehicle;
  for (std::size_t i = 1; i < steps.size(); ++i) {
    vehicle = robot_of(steps[i].frame) ? std::optional(steps[i]) : vehicle;
  }
  return vehicle;
}

// The vehicle's frame may hang below the sensor's, or beside it.
std::optional<StaticFrames::Step> StaticFrames::beside(const std::vector<Step>& steps) const {
  std::optional<Step> vehicle;
  for (const auto& [name, place] : frames_) {
    if (!robot_of(name)) {
      continue;
    }
    for (const Step& its : steps_from(name)) {
      const auto common = std::ranges::find(steps, its.frame, &Step::frame);
      if (common == steps.end()) {
        continue;
      }
      if (vehicle && robot_of(vehicle->frame) != robot_of(name)) {
        return std::nullopt;  // which of the robots?
      }
      vehicle = vehicle
                    ? vehicle
                    : Step{.frame = name,
                           .first_in_it = product(inverse(its.first_in_it), common->first_in_it),
                           .is_static = its.is_static && common->is_static};
      break;
    }
  }
  return vehicle;
}

std::string StaticFrames::mount_of(const std::string& name) const {
  const std::string frame = without_slash(name);
  if (frames_.empty() || robot_of(frame)) {
    return {};
  }
  const std::vector<Step> steps = steps_from(frame);
  std::optional<Step> vehicle = above(steps);
  vehicle = vehicle ? vehicle : beside(steps);
  if (!vehicle) {
    return "    # set mount: no fixed transform from base_link to " + printable(frame) + '\n';
  }
  const std::string its = printable(vehicle->frame);
  return mount_words(vehicle->first_in_it) + "  # in " + its +
         (vehicle->is_static ? " by /tf_static" : " by /tf") +
         (its.ends_with("base_link") ? "; z_m: add " + its + "'s height above ground" : "") + '\n';
}

}  // namespace iog::tools
