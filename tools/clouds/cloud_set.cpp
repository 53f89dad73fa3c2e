#include "tools/clouds/cloud_set.hpp"

#include <algorithm>
#include <filesystem>
#include <utility>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

// Seconds since the drive began.
std::optional<std::uint64_t> time_in(std::string_view text) {
  const std::optional<std::uint64_t> time_us = seconds_in(trimmed(text));
  return time_us ? std::optional(kDriveStartUs + *time_us) : std::nullopt;
}

// The lines of set.times that have a time, and the cloud of each.
template <typename TimeIn, typename CloudAt>
void read_times(CloudSet& set, const TimeIn& its_time_in, const CloudAt& cloud_at) {
  const std::vector<std::string> lines = read_lines(set.times);
  std::size_t missing = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (trimmed(lines[i]).empty()) {
      continue;
    }
    const std::optional<std::uint64_t> time_us = its_time_in(lines[i]);
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
  read_times(set, time_in,
             [&](std::size_t i) { return folder + "/velodyne/" + zero_padded(i, 6) + ".bin"; });
  if (std::filesystem::exists(folder + "/poses.txt")) {
    set.poses = read_kitti_log(folder + "/poses.txt");
    for (LoggedPose& pose : set.poses.poses) {
      pose.time_us += kDriveStartUs;
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
