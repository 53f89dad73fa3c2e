// The map that the image was built with (baked_map.S.in).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

// baked_map_bytes is the size of the map. NOLINTBEGIN(readability-identifier-naming): symbols of
// the assembly
extern "C" const std::array<std::uint8_t, std::size_t{4} << 20> baked_map;
extern "C" const std::uint32_t baked_map_bytes;
// NOLINTEND(readability-identifier-naming)

namespace iog::board {

// Empty if the image has no map. The map has not been checked yet.
[[nodiscard]] inline std::span<const std::uint8_t> map_of_image() {
  return std::span(baked_map).first(baked_map_bytes);
}

}  // namespace iog::board
