// Refuses TOML texts that the library must not read. It makes a table for each part of a key
// `a.b.c ...`, and needs stack for each. Of most characters beyond ASCII outside of strings and
// comments, which TOML 1.0.0 has nowhere, its code says that they cannot come.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace iog::tools {

// The most parts of a key, and the most open brackets. A car's file needs 3.
inline constexpr int kMostNesting = 8;

// `line` counts from 1.
struct TomlRefusal {
  std::uint32_t line = 0;
  std::string_view words;
};

// The first key or bracket that is nested deeper, or character beyond ASCII outside of strings and
// comments; nothing if there is none. The text need not be valid TOML; it is judged as TOML up to
// its first mistake.
[[nodiscard]] std::optional<TomlRefusal> refused_before_reading(std::string_view text);

}  // namespace iog::tools
