// The file of a key: 32 hexadecimal digits, and blanks or line ends around them.
#pragma once

#include <string>

#include "authentication/key.hpp"

namespace iog::tools {

// UsageError if there is no such file, or it holds anything else, or zeros alone. What it holds is
// never said.
[[nodiscard]] authentication::Key read_key_file(const std::string& path);

}  // namespace iog::tools
