// Text of a file or a network on its way to a terminal.
#pragma once

#include <string>

namespace iog::tools {

// With "?" in place of everything that could command a terminal; letters of UTF-8 stay. Of a long
// text the first 500 bytes.
[[nodiscard]] std::string printable(std::string text);

}  // namespace iog::tools
