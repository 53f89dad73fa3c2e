// The cells of a tile in wire order. A tile has 32 x 32 occupancy indexes of type int8, stored row
// by row, starting at the lowest y.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/tile.hpp"

namespace iog::tile_coding {

using geometry::kTileSide;
using geometry::kTileSideLog2;
inline constexpr std::size_t kTileBytes = geometry::kTileCells;

// An index is in the range -127 to +127. The byte value -128 never occurs.
inline constexpr std::byte kNoIndex{0x80};

using TileCells = std::span<const std::byte, kTileBytes>;
using MutableTileCells = std::span<std::byte, kTileBytes>;

// Returns true if all cells are 0.
[[nodiscard]] inline bool is_blank(TileCells cells) {
  for (std::size_t at = 0; at < cells.size(); at += sizeof(std::uint64_t)) {
    std::uint64_t eight = 0;
    __builtin_memcpy(&eight, &cells[at], sizeof eight);
    if (eight != 0) {
      return false;
    }
  }
  return true;
}

}  // namespace iog::tile_coding
