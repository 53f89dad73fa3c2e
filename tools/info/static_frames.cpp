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
constexpr int kMostSteps = 32;  // from a sensor to its vehicle; frames may form a loop

// Of a quaternion x, y, z, w.
Rigid rigid_of(const std::array<double, 7>& place) {
  const auto [tx, ty, tz, x, y, z, w] = place;
  const double n = 2 / (x * x + y * y + z * z + w * w);
  return {1 - n * (y * y + z * z), n * (x * y - z * w),     n * (x * z + y * w),     tx,
          n * (x * y + z * w),     1 - n * (x * x + z * z), n * (y * z - x * w),     ty,
          n * (x * z - y * w),     n * (y * z + x * w),     1 - n * (x * x + y * y), tz};
}

// Rz(yaw) Ry(pitch) Rx(roll), as tools/car/mount.hpp turns; angles of less than 0.005 are none.
std::string mount_words(const Rigid& r) {
  std::ostringstream text;
  text << std::fixed << std::setprecision(2) << "    mount = { x_m = " << r[3] << ", y_m = " << r[7]
       << ", z_m = " << r[11];
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

}  // namespace

void StaticFrames::add(const ros::RecordedMessage& message) {
  ros::CdrReader in(message.data, message.where);
  for (std::uint32_t left = in.u32(); left > 0; --left) {
    static_cast<void>(in.stamp_us());
    std::string parent = in.text();
    std::string child = in.text();
    std::array<double, 7> place{};
    std::ranges::generate(place, [&in] { return in.f64(); });
    in.must_be_whole();
    const Rigid in_parent = rigid_of(place);
    if (frames_.size() < kMostFrames &&
        std::ranges::all_of(in_parent, [](double each) { return std::isfinite(each); })) {
      frames_.insert_or_assign(std::move(child), Place{std::move(parent), in_parent});
    }
  }
}

std::string StaticFrames::mount_of(const std::string& frame) const {
  Rigid in_it{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0};
  std::string its = frame;
  std::string text;
  for (int step = 0; step < kMostSteps; ++step) {
    if (robot_of(its) && its != frame) {
      text = mount_words(in_it) + "  # in " + printable(its) +
             " by /tf_static; z_m must count from the ground\n";
    }
    const auto place = frames_.find(its);
    if (place == frames_.end()) {
      return text;
    }
    in_it = product(place->second.in_parent, in_it);
    its = place->second.parent;
  }
  return {};
}

}  // namespace iog::tools
