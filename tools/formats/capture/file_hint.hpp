// Files that people have of lidars and that are no captures: what they are, by their first bytes,
// and what to do with them.
#pragma once

#include <string>

namespace iog::tools {

// "a gzip file: unpack it first, `gunzip -k FILE`"; empty if the file cannot be read or begins as
// none that is known.
[[nodiscard]] std::string hint_of_file(const std::string& path);

}  // namespace iog::tools
