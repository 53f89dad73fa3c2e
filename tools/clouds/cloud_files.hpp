// Files of one cloud each (.pcd, .ply, .bin) as a drive: their order and their times.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "tools/clouds/cloud_fields.hpp"

namespace iog::tools {

struct CloudFile {
  std::string path;
  std::uint64_t time_us = 0;  // since 1970
  bool is_assumed = false;    // its time
};

struct CloudFiles {
  std::vector<CloudFile> files{};
  std::vector<std::string> remarks{};             // what was changed
  std::vector<std::string> remarks_if_assumed{};  // if one cloud's time is assumed
};

// Whether the name ends with .pcd, .ply or .bin, in letters of either case.
[[nodiscard]] bool is_cloud_file(const std::string& path);

// The clouds of a folder, in the order of their numbers. Empty if it has none. UsageError if they
// are of several formats or, by their names, of several lidars or drives.
[[nodiscard]] std::vector<std::string> cloud_files_in(const std::string& folder);

// Takes the files of several folders, as cloud_files_in() returns them. Returns a remark if numbers
// or times in the names of two folders overlap. Folders of two lidars do, and parts of one drive
// that are each numbered from 0. Empty: none.
[[nodiscard]] std::string words_of_overlap(const std::vector<std::vector<std::string>>& folders);

// Microseconds since 1970 of a file whose name ends with such a time: seconds, with or without a
// decimal point, seconds_nanoseconds, milliseconds, microseconds or nanoseconds, of 2001 to 2096.
// may_be_short: fewer than 7 digits behind seconds_ are nanoseconds, too.
[[nodiscard]] std::optional<std::uint64_t> time_in_name(const std::string& path,
                                                        bool may_be_short = false);

// In the order of the times in their names or, if one has none, in the order of their numbers, at
// so many clouds per second from kDriveStartUs.
[[nodiscard]] CloudFiles timed(const std::vector<std::string>& paths, double clouds_per_second);

// Reads a cloud. Its points' Unix times override an assumed time. Sets unit as cloud_of() does, if
// the format has times. UsageError if the file cannot be read or is no cloud.
[[nodiscard]] SeenCloud read_cloud_of(const CloudFile& file, TimeUnit& unit);

}  // namespace iog::tools
