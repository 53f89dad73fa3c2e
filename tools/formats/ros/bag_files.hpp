// Where the messages of a recording of ROS 2 are: in one file, or in the folder of a bag with its
// splits.
#pragma once

#include <string>
#include <vector>

#include "tools/program/interrupt.hpp"

namespace iog::tools::ros {

// Whether it is a file or folder whose messages for_each_message() reads, by its name, or
// by its first bytes if it is MCAP.
[[nodiscard]] bool is_recording(const std::string& path);

// The files of a bag in their order: those of its metadata.yaml, or without one all in the folder.
// UsageError for a folder without any, for a file that is missing and for a compression that is not
// read.
[[nodiscard]] std::vector<std::string> files_of_recording(const std::string& path);

// Remarks on the folder of a bag. With metadata.yaml: one for each file of messages that it does
// not list, and that is not read. Without: at most one, on gaps in the files' numbers.
[[nodiscard]] std::vector<std::string> remarks_on_files(const std::string& path);

// A file as it was before zstd or gzip has packed it: itself, or a copy in the folder for temporary
// files, which goes with the object. UsageError if it cannot be unpacked to its end.
class PlainFile {
 public:
  explicit PlainFile(const std::string& path);

  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string path_;
  UnfinishedFile copy_;
};

}  // namespace iog::tools::ros
