// Files that people have of lidars and that are no captures: what they are, by their first bytes,
// and what to do with them.
#pragma once

#include <cstddef>
#include <span>
#include <string>

namespace iog::tools {

// "an xz file: unpack it first, `unxz -k FILE`", of the file's first 1208 bytes; empty if none
// that is known begins so.
[[nodiscard]] std::string hint_of(std::span<const std::byte> begin);

// Whether a folder has the description or a file of a bag of ROS 2.
[[nodiscard]] bool is_folder_of_bag(const std::string& path);

// ": `iog points` makes a capture …": what to do with a recording of ROS 2.
[[nodiscard]] std::string hint_of_ros();

}  // namespace iog::tools
