// The file of a key: 32 hexadecimal digits, and blanks or line ends around them.
#pragma once

#include <string>
#include <string_view>

#include "authentication/key.hpp"

namespace iog::tools {

// UsageError if there is no such file, or it holds anything else, or zeros alone. What it holds is
// never said.
[[nodiscard]] authentication::Key read_key_file(const std::string& path);

// A line if a car has a key file that is missing or holds no key; path: empty if it has none.
[[nodiscard]] std::string warning_of_key_file(std::string_view car, const std::string& path);

}  // namespace iog::tools
