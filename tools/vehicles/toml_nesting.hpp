// How deep a text of TOML nests tables and arrays, found without nesting anything: a library that
// makes a table for each part of a key `a.b.c ...` needs stack for each of them.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace iog::tools {

// A key may have so many parts, and so many brackets may be open at a place. A car's file needs 3.
inline constexpr int kMostNesting = 8;

// The line, from 1, of the first key or bracket that is deeper; nothing if none is. The text need
// not be TOML: up to its first mistake it is judged as TOML.
[[nodiscard]] std::optional<std::uint32_t> line_of_deep_nesting(std::string_view text);

}  // namespace iog::tools
