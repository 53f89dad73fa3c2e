// Measures how deep a TOML text nests tables and arrays, without recursion: a library that makes a
// table for each part of a key `a.b.c ...` needs stack for each.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace iog::tools {

// The most parts of a key, and the most open brackets. A car's file needs 3.
inline constexpr int kMostNesting = 8;

// The line, from 1, of the first key or bracket that is deeper; nothing if none is. The text need
// not be valid TOML; it is judged as TOML up to its first mistake.
[[nodiscard]] std::optional<std::uint32_t> line_of_deep_nesting(std::string_view text);

}  // namespace iog::tools
