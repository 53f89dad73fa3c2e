#include "tools/formats/capture/file_hint.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <string_view>

namespace iog::tools {
namespace {

using namespace std::string_view_literals;

struct Kind {
  std::string_view begin;
  std::string_view hint;
};

constexpr std::string_view kOfRos =
    ": `iog points` makes a capture of its clouds and scans, `iog convert --bag` of the packets of "
    "a "
    "lidar, and --poses reads its poses";

constexpr std::string_view kOfCloud = "a point cloud, of which `iog points` makes a capture";

// The file formats of xz, bzip2, lz4, ZIP, ROS bags 2.0, SQLite, MCAP, PLY, PCD, NMEA;
// docs/spec.md 1 and 6.
constexpr std::array<Kind, 14> kKinds{
    {{"\xFD\x37\x7A\x58\x5A\x00"sv, "an xz file: unpack it first, `unxz -k FILE`"},
     {"BZh"sv, "a bzip2 file: unpack it first, `bunzip2 -k FILE`"},
     {"\x04\x22\x4D\x18"sv, "an lz4 file: unpack it first, `unlz4 FILE`"},
     {"PK\x03\x04"sv, "a ZIP file: unpack it first, `unzip FILE`"},
     {"#ROSBAG V"sv,
      "a bag of ROS 1: convert it to one of ROS 2 first, for example by rosbags-convert"},
     {"SQLite format 3\x00"sv, "an SQLite file, as a bag of ROS 2 is"},
     {"\x89MCAP0\r\n"sv,
      "an MCAP file; `iog record --stream` takes what iog has written. Of ROS 2"},
     {"\xAF\xFE\xC0\xC2"sv,
      "raw ibeo messages: `iog convert --raw FILE:SENSOR --out drive.pcap` makes a capture of "
      "scans "
      "0x2202"},
     {"IOGM"sv, "a map of `iog map`, and no capture"},
     {"ply\n"sv, kOfCloud},
     {"ply\r\n"sv, kOfCloud},
     {"# .PCD"sv, kOfCloud},
     {"time_s"sv, "a log of poses, which --poses reads beside a capture"},
     {"$G"sv, "a receiver's log, of which --poses reads the poses beside a capture"}}};

// Payloads of 1206 bytes one behind the other, of which each begins with the flag of a block.
bool is_raw_velodyne(std::string_view bytes) {
  constexpr std::size_t kPayload = 1206;
  constexpr auto kFlag = "\xFF\xEE"sv;
  return bytes.starts_with(kFlag) &&
         (bytes.size() == kPayload ||
          bytes.substr(std::min(kPayload, bytes.size())).starts_with(kFlag));
}

}  // namespace

std::string hint_of(std::span<const std::byte> begin) {
  const std::string_view bytes(reinterpret_cast<const char*>(begin.data()), begin.size());
  for (const Kind& kind : kKinds) {
    if (bytes.starts_with(kind.begin)) {
      const bool is_of_ros = kind.begin.starts_with('S') || kind.begin.starts_with('\x89');
      return std::string(kind.hint).append(is_of_ros ? kOfRos : "");
    }
  }
  return is_raw_velodyne(bytes) ? "raw Velodyne payloads: `iog convert --raw FILE:SENSOR --vehicle "
                                  "NAME --out drive.pcap` makes a capture of them"
                                : "";
}

bool is_folder_of_bag(const std::string& path) {
  const std::filesystem::directory_iterator entries(path);
  return std::any_of(begin(entries), end(entries), [](const std::filesystem::path& entry) {
    return entry.filename() == "metadata.yaml" || entry.extension() == ".db3" ||
           entry.extension() == ".mcap";
  });
}

std::string hint_of_ros() { return std::string(kOfRos); }

}  // namespace iog::tools
