// Which format a log has.
#include <algorithm>
#include <filesystem>

#include "tools/formats/mcap/format.hpp"
#include "tools/poses/pose_log.hpp"
#include "tools/poses/text_fields.hpp"
#include "tools/program/exit_status.hpp"
#include "tools/program/file.hpp"

namespace iog::tools {
namespace {

namespace files = std::filesystem;

std::string format_of_folder(const files::path& folder) {
  return files::exists(folder / "oxts") || files::exists(folder / "timestamps.txt") ? "oxts"
         : files::exists(folder / "poses.txt")                                      ? "kitti"
                                                                                    : "";
}

// By the first row that says something.
std::string format_of_text(std::string_view text) {
  for (const std::string_view line : lines_of(text)) {
    if (line.find("time_s") != std::string_view::npos) {
      return "csv";
    }
    if (line.starts_with('$')) {
      return "nmea";
    }
    if (!trimmed(line).empty() && !line.starts_with('#')) {
      const std::size_t words = words_of(line).size();
      return words == 8 ? "tum" : words == 12 ? "kitti" : "";
    }
  }
  return "";
}

std::string format_of(const std::string& path) {
  if (files::is_directory(path)) {
    return format_of_folder(path);
  }
  const std::string suffix = files::path(path).extension();
  if (const auto* const known =
          std::ranges::find(kPoseFormats, suffix.substr(suffix.empty() ? 0 : 1));
      known != kPoseFormats.end()) {
    return std::string(*known);
  }
  const std::vector<std::byte> bytes = read_file(path);
  if (bytes.empty()) {
    throw UsageError(path + ": empty");
  }
  const std::span begin = std::span(bytes).first(std::min<std::size_t>(bytes.size(), 4096));
  if (!ubx_message_at(bytes).empty()) {
    return "ubx";
  }
  return std::ranges::equal(begin.first(std::min(begin.size(), mcap::kMagic.size())),
                            std::as_bytes(std::span(mcap::kMagic)))
             ? "mcap"
             : format_of_text(text_in(path, begin));
}

// "drive.mcap:/odom", unless there is a file of that name.
struct FileAndTopic {
  std::string file;
  std::string topic;
};
FileAndTopic parts_of_input(const std::string& path) {
  const std::size_t colon = path.rfind(":/");
  return colon == std::string::npos || files::exists(path)
             ? FileAndTopic{path, ""}
             : FileAndTopic{path.substr(0, colon), path.substr(colon + 1)};
}

}  // namespace

PoseLog read_pose_log(const std::string& input, const std::string& format) {
  const auto [path, topic] = parts_of_input(input);
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
    return read_ros_log(path, topic);
  }
  if (its != "nmea" && its != "ubx") {
    throw UsageError(path +
                     ": no log of poses that is known: csv, oxts, nmea, ubx, tum, kitti, mcap");
  }
  const std::vector<std::byte> bytes = read_file(path);
  if (its == "nmea") {
    static_cast<void>(text_in(path, bytes));
    return read_nmea_log(bytes);
  }
  return read_ubx_log(bytes);
}

}  // namespace iog::tools
