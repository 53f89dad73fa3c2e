// Which format a log has.
#include <algorithm>
#include <filesystem>

#include "tools/formats/capture/file_hint.hpp"
#include "tools/formats/mcap/format.hpp"
#include "tools/formats/ros/bag_files.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

namespace files = std::filesystem;

// By the first row that says something.
std::string format_of_text(std::string_view text) {
  for (const std::string_view line : lines_of(text)) {
    if (line.starts_with('$') || line.find("time_s") != std::string_view::npos) {
      return line.starts_with('$') ? "nmea" : "csv";
    }
    if (!trimmed(line).empty() && !line.starts_with('#')) {
      const std::size_t words = words_of(line).size();
      return words == 8 ? "tum" : words == 12 ? "kitti" : "";
    }
  }
  return "";
}

std::string format_of(const std::string& path) {
  if (ros::is_recording(path)) {
    return "mcap";
  }
  if (files::is_directory(path)) {
    const bool is_oxts = files::exists(path + "/oxts") || files::exists(path + "/timestamps.txt");
    return files::exists(path + "/poses.txt") ? "kitti" : is_oxts ? "oxts" : "";
  }
  const std::string suffix = files::path(path).extension();
  for (const std::string_view format : kPoseFormats) {
    if (suffix == "." + std::string(format)) {
      return suffix.substr(1);
    }
  }
  std::vector<std::byte> bytes = read_file(path);
  if (bytes.empty()) {
    throw empty_file(path);
  }
  const bool is_ubx = !ubx_message_at(bytes).empty();
  bytes.resize(std::min<std::size_t>(bytes.size(), 4096));
  const bool is_mcap = std::ranges::mismatch(bytes, std::as_bytes(std::span(mcap::kMagic))).in2 ==
                       std::as_bytes(std::span(mcap::kMagic)).end();
  return is_ubx ? "ubx" : is_mcap ? "mcap" : format_of_text(text_in(path, bytes));
}

}  // namespace

PoseLog read_pose_log(const std::string& input, const std::string& format) {
  const std::size_t colon = files::exists(input) ? std::string::npos : input.rfind(":/");
  const std::string path = input.substr(0, colon);
  const std::string its = format.empty() ? format_of(path) : format;
  if (its == "csv") {
    return read_csv_log(path);
  }
  if (its == "oxts") {
    return read_oxts_log(files::exists(path + "/oxts") ? path + "/oxts" : path);
  }
  if (its == "tum") {
    return read_tum_log(path);
  }
  if (its == "kitti") {
    return read_kitti_log(files::is_directory(path) ? path + "/poses.txt" : path);
  }
  if (its == "mcap") {
    return read_ros_log(path, colon == std::string::npos ? "" : input.substr(colon + 1));
  }
  if (its.empty()) {
    const std::string hint = files::is_directory(path) ? "" : hint_of(read_file(path));
    throw UsageError(
        path + (hint.empty() ? ": no log of poses that is read: csv, oxts, nmea, ubx, tum, kitti, "
                               "mcap or rosbag2"
                             : ": not a pose log that iog reads; it is " + hint));
  }
  const std::vector<std::byte> bytes = read_file(path);
  static_cast<void>(its == "nmea" ? text_in(path, bytes) : "");
  return its == "nmea" ? read_nmea_log(bytes) : read_ubx_log(bytes);
}

}  // namespace iog::tools
