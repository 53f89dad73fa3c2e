#include "tools/clouds/cloud_set.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <utility>

#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools {
namespace {

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
      throw UsageError(set.times + ":" + std::to_string(i + 1) + ": '" + printable(lines[i]) +
                       "' is no time");
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
  remark(missing, "time|times without a cloud", set.remarks);
  const std::string folder = std::filesystem::path(cloud_at(0)).parent_path();
  remark(files_beside(folder, ".bin", set.clouds.size() - missing), "cloud|clouds without a time",
         set.remarks);
}

// Poses of another drive would place the clouds anywhere.
void demand_same_time(const CloudSet& set) {
  const std::vector<LoggedPose>& poses = set.poses.poses;
  if (!poses.empty() && (poses.back().time_us < set.forward.front().time_us ||
                         set.forward.back().time_us < poses.front().time_us)) {
    throw UsageError(set.times + ": no pose of oxts is of its times");
  }
}

CloudSet read_raw(const std::string& folder) {
  CloudSet set{.times = folder + "/velodyne_points/timestamps.txt"};
  read_times(set, date_time_in, [&](std::size_t i) {
    return folder + "/velodyne_points/data/" + zero_padded(i, 10) + ".bin";
  });
  if (std::filesystem::exists(folder + "/oxts")) {
    set.poses = read_oxts_log(folder + "/oxts");
    demand_same_time(set);
  } else {
    set.remarks.emplace_back("no poses: there is no oxts");
  }
  return set;
}

CloudSet read_odometry(const std::string& folder) {
  CloudSet set{.times = folder + "/times.txt", .is_corrected = true};
  read_times(set, kitti_time_in,
             [&](std::size_t i) { return folder + "/velodyne/" + zero_padded(i, 6) + ".bin"; });
  if (std::filesystem::exists(folder + "/poses.txt")) {
    set.poses = read_kitti_log(folder + "/poses.txt");
  } else {
    set.remarks.emplace_back("no poses: there is no poses.txt");
  }
  if (set.poses.in_space.empty()) {
    set.remarks.emplace_back("no way back to where points were seen: each cloud is as of one time");
  }
  return set;
}

void add(const CloudPoint& point, double after_us, SeenCloud& cloud) {
  WirePoint sent = direction_of(point.x, point.y, point.z);
  if (sent.third == 0) {
    ++cloud.nowhere;
    return;
  }
  sent.after_us = static_cast<std::uint32_t>(std::lround(std::max(0.0, after_us)));
  cloud.points.push_back(sent);
}

CloudPoint moved(const Rigid& by, const CloudPoint& point) {
  const auto row = [&](std::size_t i) {
    return by[i] * point.x + by[i + 1] * point.y + by[i + 2] * point.z + by[i + 3];
  };
  return {row(0), row(4), row(8)};
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
                   "its odometry data, nor a file .pcd, .ply or .bin is in this folder");
}

// A point of a corrected cloud stood still while the unit moved on, or had not come so far: the
// unit's whole motion is taken back, as it pitches and rolls on a road.
CloudPoint seen_at(const CloudSet& set, std::size_t cloud, const CloudPoint& point,
                   double time_us) {
  if (set.poses.in_space.empty()) {
    return point;
  }
  const auto time_of = [](const ForwardTime& its) { return static_cast<double>(its.time_us); };
  const auto after = std::ranges::upper_bound(set.forward, time_us, {}, time_of);
  const auto to = static_cast<std::size_t>(
      std::clamp<std::ptrdiff_t>(after - set.forward.begin(), 1, std::ssize(set.forward) - 1));
  const double from_us = time_of(set.forward[to - 1]);
  const double part = (time_us - from_us) / (time_of(set.forward[to]) - from_us);
  const Rigid then = between(set.poses.in_space[to - 1], set.poses.in_space[to], part);
  return moved(inverse(then), moved(set.poses.in_space[cloud], point));
}

SeenCloud read_kitti_cloud(const std::string& path, std::uint64_t stamp_us) {
  const PointCloud cloud = read_cloud(path, path.ends_with(".pcd.bin") ? 5 : 4);
  SeenCloud seen{.time_us = stamp_us, .not_finite = cloud.not_finite};
  std::ranges::for_each(cloud.points, [&](const CloudPoint& point) { add(point, 0, seen); });
  return seen;
}

// When a point was seen depends on where it was then; each round comes nearer by the ratio of the
// car's speed to that of the beam's end.
std::vector<std::string> for_each_of_set(const std::string& folder,
                                         const std::function<void(SeenCloud&&)>& take) {
  constexpr int kRounds = 4;
  CloudSet set = read_cloud_set(folder);
  const Head head(set.forward, set.times);
  const auto begin_us = static_cast<double>(head.first().time_us);
  for (std::size_t i = 0; i < set.clouds.size(); ++i) {
    if (set.clouds[i].empty()) {
      continue;
    }
    const PointCloud cloud = read_cloud(set.clouds[i]);
    const auto turn = static_cast<double>(set.forward[i].turn);
    const double from_us = begin_us + head.time_at(turn - 0.5);
    SeenCloud seen{.time_us = static_cast<std::uint64_t>(from_us),
                   .has_times = true,
                   .not_finite = cloud.not_finite};
    for (const CloudPoint& point : cloud.points) {
      CloudPoint there = point;
      double time_us = 0;
      for (int round = 0; round < kRounds; ++round) {
        const double right = -std::atan2(there.y, there.x) / (2 * std::numbers::pi);
        time_us = begin_us + head.time_at(turn + right);
        there = seen_at(set, i, point, time_us);
      }
      add(there, time_us - from_us, seen);
    }
    take(std::move(seen));
  }
  return set.remarks;
}

}  // namespace iog::tools
