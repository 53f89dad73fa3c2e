#include "tools/clouds/cloud_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <utility>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

Rigid rigid_in(std::string_view text, const std::string& where) {
  Rigid rigid{};
  std::size_t count = 0;
  for (const std::string_view part : parts_of(trimmed(text), ' ')) {
    const std::optional<double> value = number_in(part);
    if (!value || count == rigid.size()) {
      throw UsageError(where + ": 12 numbers have to be there, three rows of a pose");
    }
    rigid[count++] = *value;
  }
  if (count != rigid.size()) {
    throw UsageError(where + ": " + std::to_string(count) + " numbers instead of 12");
  }
  // A row of a rotation has length 1.
  for (std::size_t row = 0; row < 3; ++row) {
    const double length = std::hypot(rigid[row * 4], rigid[row * 4 + 1], rigid[row * 4 + 2]);
    if (std::abs(length - 1) > 0.01) {
      throw UsageError(where + ": row " + std::to_string(row + 1) + " is no row of a rotation");
    }
  }
  return rigid;
}

// What calib.txt says of the unit.
Rigid unit_in_camera(const std::string& path) {
  for (const std::string& line : read_lines(path)) {
    if (line.starts_with("Tr:")) {
      return rigid_in(std::string_view(line).substr(3), path);
    }
  }
  throw UsageError(path + ": no line Tr: says where the unit is");
}

// One pose for each cloud, in the frame of the first: x forward, y left.
std::vector<Rigid> poses_of_unit(const std::string& folder,
                                 const std::vector<ForwardTime>& forward) {
  const std::string path = folder + "/poses.txt";
  const std::vector<std::string> lines = read_lines(path);
  const Rigid unit = unit_in_camera(folder + "/calib.txt");
  const Rigid camera = inverse(unit);
  std::vector<Rigid> poses;
  for (const ForwardTime& at : forward) {
    if (at.turn >= lines.size()) {
      throw UsageError(path + ": " + std::to_string(lines.size()) + " poses, and times of " +
                       std::to_string(forward.size()));
    }
    poses.push_back(product(
        camera, product(rigid_in(lines[at.turn], path + ":" + std::to_string(at.turn + 1)), unit)));
  }
  return poses;
}

std::optional<std::uint64_t> seconds_in(std::string_view text) {
  const std::optional<double> seconds = number_in(trimmed(text));
  if (!seconds || *seconds < 0 || *seconds > 1e7) {
    return std::nullopt;
  }
  return kDriveStartUs + static_cast<std::uint64_t>(std::llround(*seconds * 1e6));
}

// The lines of set.times that have a time, and the cloud of each.
template <typename TimeIn, typename CloudAt>
void read_times(CloudSet& set, const TimeIn& time_in, const CloudAt& cloud_at) {
  const std::vector<std::string> lines = read_lines(set.times);
  std::size_t missing = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (trimmed(lines[i]).empty()) {
      continue;
    }
    const std::optional<std::uint64_t> time_us = time_in(lines[i]);
    if (!time_us) {
      throw UsageError(set.times + ":" + std::to_string(i + 1) + ": '" + lines[i] + "' is no time");
    }
    std::string cloud = cloud_at(i);
    const bool is_there = std::filesystem::exists(cloud);
    missing += is_there ? 0U : 1U;
    set.forward.push_back({.turn = i, .time_us = *time_us});
    set.clouds.push_back(is_there ? std::move(cloud) : std::string());
  }
  if (missing == set.clouds.size()) {
    throw UsageError(set.times + ": no cloud of its times is there; the first would be " +
                     cloud_at(0));
  }
  remark(missing, "times without a cloud", set.remarks);
}

CloudSet read_raw(const std::string& folder) {
  CloudSet set{.times = folder + "/velodyne_points/timestamps.txt"};
  read_times(set, date_time_in, [&](std::size_t i) {
    return folder + "/velodyne_points/data/" + zero_padded(i, 10) + ".bin";
  });
  if (std::filesystem::exists(folder + "/oxts")) {
    set.poses = read_oxts_log(folder + "/oxts");
  } else {
    set.remarks.emplace_back("no poses: there is no oxts");
  }
  return set;
}

CloudSet read_odometry(const std::string& folder) {
  CloudSet set{.times = folder + "/times.txt", .is_corrected = true};
  read_times(set, seconds_in,
             [&](std::size_t i) { return folder + "/velodyne/" + zero_padded(i, 6) + ".bin"; });
  if (std::filesystem::exists(folder + "/poses.txt")) {
    set.unit_poses = poses_of_unit(folder, set.forward);
    for (std::size_t i = 0; i < set.forward.size(); ++i) {
      const Rigid& pose = set.unit_poses[i];
      set.poses.poses.push_back({.time_us = set.forward[i].time_us,
                                 .x_m = pose[3],
                                 .y_m = pose[7],
                                 .heading_rad = std::atan2(pose[4], pose[0])});
    }
  } else {
    set.remarks.emplace_back("no poses: there is no poses.txt");
  }
  return set;
}

}  // namespace

CloudSet read_cloud_set(const std::string& folder) {
  if (std::filesystem::is_directory(folder + "/velodyne_points")) {
    return read_raw(folder);
  }
  if (std::filesystem::is_directory(folder + "/velodyne")) {
    return read_odometry(folder);
  }
  throw UsageError(folder +
                   ": neither velodyne_points, as in KITTI's raw data, nor velodyne, as in "
                   "its odometry data, is in this folder");
}

}  // namespace iog::tools
