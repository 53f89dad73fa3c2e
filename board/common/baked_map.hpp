// The map that the build has included in the image (baked_map.S.in).
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

// Returns the unchecked map, or an empty span if the image has no map.
[[nodiscard]] inline std::span<const std::uint8_t> map_of_image() {
  return std::span(baked_map).first(baked_map_bytes);
}

}  // namespace iog::board
