// What is in a file, in a few lines for a person. What kind it is tells its content, not its name.
#pragma once

#include <cstdint>
#include <string>

namespace iog::tools {

// A capture, an MCAP file, a map, or a folder of pictures and a map. UsageError if it is nothing of
// these or cannot be read.
[[nodiscard]] std::string summary_of_file(const std::string& path);

[[nodiscard]] std::string summary_of_capture(const std::string& path);
[[nodiscard]] std::string summary_of_mcap(const std::string& path);
// The YAML of a map, and the picture that it names.
[[nodiscard]] std::string summary_of_map(const std::string& path);
[[nodiscard]] std::string summary_of_pgm(const std::string& path);
[[nodiscard]] std::string summary_of_folder(const std::string& path);

// What a file says goes to a terminal: nothing in it may command one.
[[nodiscard]] std::string printable(std::string text);

// "12.345 s".
[[nodiscard]] std::string seconds(std::uint64_t micros);

}  // namespace iog::tools
