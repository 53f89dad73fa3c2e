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

}  // namespace iog::tools
