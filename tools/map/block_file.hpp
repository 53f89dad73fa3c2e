// A map block as a file.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace iog::tools {

// UsageError if the file cannot be read or is no sound block, with the reason.
[[nodiscard]] std::vector<std::uint8_t> read_block(const std::string& path);

}  // namespace iog::tools
