// What is in a file, in a few lines for a person. What kind it is tells its content, not its name.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace iog::tools {

// A capture, an MCAP file, a bag of ROS 2, a map of ROS, a map block, or a folder of pictures and a
// map. UsageError if it is nothing of these or cannot be read.
[[nodiscard]] std::string summary_of_file(const std::string& path);

[[nodiscard]] std::string summary_of_capture(const std::string& path);
[[nodiscard]] std::string summary_of_mcap(const std::string& path);
[[nodiscard]] std::string summary_of_bag(const std::string& path);
// The YAML of a map, and the picture that it names.
[[nodiscard]] std::string summary_of_map(const std::string& path);
[[nodiscard]] std::string summary_of_pgm(const std::string& path);
// A map block (map/block.hpp), sound or not.
[[nodiscard]] std::string summary_of_block(std::span<const std::uint8_t> bytes);
[[nodiscard]] std::string summary_of_block_file(const std::string& path);
[[nodiscard]] bool is_block_file(const std::string& path);
// CheckFailed if the file is a block that a target would refuse.
void demand_accepted_block(const std::string& path);
[[nodiscard]] std::string summary_of_folder(const std::string& path);

// "12.345 s".
[[nodiscard]] std::string seconds(std::uint64_t micros);

}  // namespace iog::tools
