// Letters of 5 by 7 dots: capitals, digits and a few signs, enough for a legend.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace iog::tools {

inline constexpr int kGlyphWidth = 5;
inline constexpr int kGlyphHeight = 7;

// Column by column from the left, the lowest bit on top.
using Glyph = std::array<std::uint8_t, kGlyphWidth>;

[[nodiscard]] Glyph glyph_of(char letter);

// UTF-8 in letters that there are: (C) for a copyright sign.
[[nodiscard]] std::string spelled(std::string_view words);

[[nodiscard]] constexpr bool is_dot(const Glyph& glyph, int column, int row) {
  return (glyph[static_cast<std::size_t>(column)] >> row & 1) != 0;
}

}  // namespace iog::tools
