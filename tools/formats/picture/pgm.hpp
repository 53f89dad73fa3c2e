// Grey pictures in the simplest format there is (PGM, binary).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace iog::tools {

// pixels: width * height of them, row by row from the top. remark: one line in its header; empty:
// none. UsageError if it cannot be written.
void write_pgm(const std::string& path, std::size_t width, std::size_t height,
               std::span<const std::uint8_t> pixels, std::string_view remark = {});

// Whether it is a file of write_pgm() with this remark, which is not empty.
[[nodiscard]] bool has_remark(const std::string& path, std::string_view remark);

}  // namespace iog::tools
