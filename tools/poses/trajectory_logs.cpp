// The trajectories of SLAM programs and benchmarks: rows of numbers between blanks.
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>

#include "tools/formats/capture/made_capture.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/poses/rigid.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/printable.hpp"
#include "tools/program/table.hpp"

namespace iog::tools {
namespace {

template <std::size_t kCount>
std::array<double, kCount> numbers_in(std::string_view text, const std::string& where,
                                      std::string_view what) {
  std::array<double, kCount> numbers{};
  const std::vector<std::string_view> words = words_of(text);
  if (words.size() != kCount) {
    throw UsageError(where + ": " + std::to_string(words.size()) + " numbers instead of " +
                     std::to_string(kCount) + ": " + std::string(what));
  }
  for (std::size_t i = 0; i < kCount; ++i) {
    const std::optional<double> value = number_in(words[i]);
    if (!value) {
      throw UsageError(where + ": '" + printable(std::string(words[i])) + "' is not a number");
    }
    numbers[i] = *value;
  }
  return numbers;
}

Rigid rigid_in(std::string_view text, const std::string& where) {
  const Rigid rigid = numbers_in<12>(text, where, "three rows of a pose");
  // The rows of a rotation have length 1, and the third row is the cross product of the others.
  for (std::size_t row = 0; row < 3; ++row) {
    const double length = std::hypot(rigid[row * 4], rigid[row * 4 + 1], rigid[row * 4 + 2]);
    if (std::abs(length - 1) > 0.01) {
      throw UsageError(where + ": row " + std::to_string(row + 1) + " is no row of a rotation");
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t next = (i + 1) % 3;
    const std::size_t last = (i + 2) % 3;
    const double cross = rigid[next] * rigid[4 + last] - rigid[last] * rigid[4 + next];
    if (std::abs(cross - rigid[8 + i]) > 0.02) {
      throw UsageError(where + ": its rows are no rotation");
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

// Lines up to the last one that is not blank.
std::vector<std::string> rows_in(const std::string& path) {
  std::vector<std::string> lines = read_lines(path);
  while (!lines.empty() && trimmed(lines.back()).empty()) {
    lines.pop_back();
  }
  return lines;
}

std::string place_of(const std::string& path, std::size_t line) {
  return path + ':' + std::to_string(line + 1);
}

std::uint64_t demanded(std::optional<std::uint64_t> time_us, std::string_view text,
                       const std::string& where) {
  if (!time_us) {
    throw UsageError(where + ": the time is '" + printable(std::string(text)) +
                     "': give seconds, 0 or more");
  }
  return *time_us;
}

}  // namespace

std::optional<double> heading_of(const Quaternion& turn) {
  const auto& [x, y, z, w] = turn;
  const double length = std::sqrt(x * x + y * y + z * z + w * w);
  // Of the vehicle's x, seen from above.
  const double heading = std::atan2(2 * (w * z + x * y), w * w + x * x - y * y - z * z);
  return std::abs(length - 1) < 0.01 ? std::optional(heading) : std::nullopt;
}

bool is_tilted(const Quaternion& turn) {
  return 1 - 2 * (turn[0] * turn[0] + turn[1] * turn[1]) < std::numbers::sqrt2 / 2;
}

PoseLog read_tum_log(const std::string& path) {
  const std::vector<std::string> lines = read_lines(path);
  PoseLog log;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string_view line = trimmed(lines[i]);
    if (line.empty() || line.starts_with('#')) {
      continue;
    }
    const std::string where = place_of(path, i);
    const auto numbers = numbers_in<8>(line, where, "timestamp tx ty tz qx qy qz qw");
    const Quaternion turn{numbers[4], numbers[5], numbers[6], numbers[7]};
    const auto heading = heading_of(turn);
    if (!heading) {
      throw UsageError(where + ": qx qy qz qw are no rotation, which has the length 1");
    }
    log.poses.push_back(
        {.time_us = demanded(seconds_in(words_of(line)[0]), words_of(line)[0], where),
         .x_m = numbers[1],
         .y_m = numbers[2],
         .heading_rad = heading,
         .is_tilted = is_tilted(turn),
         .place = i + 1});
  }
  return log;
}

std::optional<std::uint64_t> kitti_time_in(std::string_view line) {
  const std::optional<std::uint64_t> time_us = seconds_in(trimmed(line));
  return time_us ? std::optional(kDriveStartUs + *time_us) : std::nullopt;
}

PoseLog read_kitti_log(const std::string& path) {
  const std::string folder = std::filesystem::absolute(path).parent_path();
  const std::vector<std::string> lines = rows_in(path);
  const std::vector<std::string> times = rows_in(folder + "/times.txt");
  if (lines.size() != times.size()) {
    throw UsageError(path + ": " + counted(lines.size(), "pose|poses, and times of ") +
                     std::to_string(times.size()));
  }
  const Rigid unit = unit_in_camera(folder + "/calib.txt");
  const Rigid camera = inverse(unit);
  PoseLog log{.is_of_unit = true};
  for (std::size_t i = 0; i < times.size(); ++i) {
    if (trimmed(times[i]).empty()) {
      continue;
    }
    const Rigid pose = product(camera, product(rigid_in(lines[i], place_of(path, i)), unit));
    log.in_space.push_back(pose);
    log.poses.push_back({.time_us = demanded(kitti_time_in(times[i]), trimmed(times[i]),
                                             place_of(folder + "/times.txt", i)),
                         .x_m = pose[3],
                         .y_m = pose[7],
                         .heading_rad = std::atan2(pose[4], pose[0]),
                         .place = i + 1});
  }
  return log;
}

}  // namespace iog::tools
