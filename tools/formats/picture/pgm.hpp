// Grey pictures in the simplest format there is (PGM, binary).
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace iog::tools {

// pixels: width * height of them, row by row from the top. UsageError if it cannot be written.
void write_pgm(const std::string& path, std::size_t width, std::size_t height,
               std::span<const std::uint8_t> pixels);

}  // namespace iog::tools
