// The mark by which iog knows its own pictures: a chunk of text in the PNG, "Software: iogrid".
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace iog::tools {

// The same picture with the mark behind its header.
[[nodiscard]] std::vector<std::byte> with_mark(std::span<const std::byte> png);

// Whether iog wrote this file: it has the mark, or begins as iog's pictures did before the mark.
[[nodiscard]] bool is_own_picture(const std::string& path);

}  // namespace iog::tools
