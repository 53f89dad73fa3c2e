// The recordings of a batch: captures, each with the log of its poses beside it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace iog::tools {

struct ListedCapture {
  std::string name;         // as listed, or relative to the folder; no other recording has it
  std::string path;         // absolute
  std::string poses;        // absolute; empty: they are in the capture
  std::uint64_t bytes = 0;  // of the capture; 0 if it cannot be read
  std::string refusal{};    // why it is not fused; empty if it is fused
};

// All captures in a folder and in the folders below, or those that a text file lists, one a line,
// relative to the file. The largest are first, so that all processes end at about the same time.
// A capture with two logs is refused. UsageError if there is no capture.
[[nodiscard]] std::vector<ListedCapture> recordings_of(const std::string& folder_or_list);

}  // namespace iog::tools
