#include <array>
#include <cmath>
#include <filesystem>

#include "tools/poses/local_plane.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"
#include "tools/program/printable.hpp"

namespace iog::tools {
namespace {

// Fields of a file, by dataformat.txt beside the data.
constexpr std::size_t kFields = 30;
constexpr std::size_t kLatitude = 0;        // degrees
constexpr std::size_t kLongitude = 1;       // degrees
constexpr std::size_t kYaw = 5;             // radians, 0 is east, counter-clockwise
constexpr std::size_t kForward = 8;         // m/s
constexpr std::size_t kTurnUp = 22;         // rad/s about the axis that points up
constexpr std::size_t kSpeedAccuracy = 24;  // m/s

std::array<double, kFields> fields_in(const std::string& path) {
  const std::vector<std::string> lines = read_lines(path);
  std::array<double, kFields> fields{};
  std::size_t count = 0;
  const std::string_view line = lines.empty() ? std::string_view() : lines.front();
  for (const std::string_view part : words_of(line)) {
    const std::optional<double> value = number_in(part);
    if (!value || count == kFields) {
      throw UsageError(path + ": field " + std::to_string(count + 1) + " of " +
                       std::to_string(kFields) + " is '" + printable(std::string(part)) + "'");
    }
    fields[count++] = *value;
  }
  if (count != kFields) {
    throw UsageError(path + ": " + std::to_string(count) + " numbers instead of " +
                     std::to_string(kFields));
  }
  if (std::abs(fields[kLatitude]) > 90 || std::abs(fields[kLongitude]) > 180) {
    throw UsageError(path + ": " + std::to_string(fields[kLatitude]) + ", " +
                     std::to_string(fields[kLongitude]) + " is no place on the earth");
  }
  return fields;
}

}  // namespace

PoseLog read_oxts_log(const std::string& folder) {
  const std::string times = folder + "/timestamps.txt";
  const std::vector<std::string> lines = read_lines(times);
  std::size_t missing = 0;
  PoseLog log;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (trimmed(lines[i]).empty()) {
      continue;
    }
    const std::optional<std::uint64_t> time_us = date_time_in(lines[i]);
    if (!time_us) {
      throw UsageError(times + ":" + std::to_string(i + 1) + ": '" + printable(lines[i]) +
                       "' is no time as in 2011-09-26 13:02:25.964389445");
    }
    const std::string path = folder + "/data/" + zero_padded(i, 10) + ".txt";
    if (!std::filesystem::exists(path)) {
      ++missing;  // KITTI has such drives
      continue;
    }
    const std::array<double, kFields> fields = fields_in(path);
    if (!log.plane) {
      log.plane.emplace(fields[kLatitude], fields[kLongitude]);
    }
    const double accuracy_mps = fields[kSpeedAccuracy];
    const LocalPlane::Place place = log.plane->place_of(fields[kLatitude], fields[kLongitude]);
    log.poses.push_back({.time_us = *time_us,
                         .x_m = place.east_m,
                         .y_m = place.north_m,
                         .heading_rad = fields[kYaw],
                         .speed_mps = fields[kForward],
                         .yaw_rate_rps = fields[kTurnUp],
                         // The error of the speed is that of the way in a second.
                         .sigma_m = accuracy_mps > 0 ? std::optional(accuracy_mps) : std::nullopt,
                         .sigma_heading_rad = std::nullopt,
                         .place = i + 1});
  }
  remark(missing, "time|times without a file in data/", log.remarks);
  remark(files_beside(folder + "/data", ".txt", log.poses.size()),
         "file|files in data/ without a time", log.remarks);
  return log;
}

}  // namespace iog::tools
