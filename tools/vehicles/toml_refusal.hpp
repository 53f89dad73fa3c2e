// Refuses TOML texts that the library must not read. The library makes a table for each part of a
// key `a.b.c ...`, and needs stack for each. Its behaviour is undefined for some characters beyond
// ASCII outside of strings and comments, where TOML 1.0.0 has none.
#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

namespace iog::tools {

// `line` counts from 1.
struct TomlRefusal {
  std::uint32_t line = 0;
  std::string_view words;
};

// Finds the first place that is nested more than eight deep, or has a character beyond ASCII
// outside of strings and comments; nothing if there is none. The text need not be valid TOML; it is
// judged as TOML up to its first mistake.
[[nodiscard]] std::optional<TomlRefusal> refused_before_reading(std::string_view text);

}  // namespace iog::tools
