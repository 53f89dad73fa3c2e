// Which cells of a fusion were freed from below, or hit by something tall.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fusion/frame_fusion.hpp"
#include "geometry/grid.hpp"

namespace iog::tests {

inline bool has_bit(const grid::TileBits& bits, geometry::Cell cell) {
  const auto x = static_cast<std::uint32_t>(cell.x) % geometry::kTileSide;
  const auto y = static_cast<std::uint32_t>(cell.y) % geometry::kTileSide;
  return (bits[y] >> x & 1U) != 0;
}

inline bool low_or_tall(const fusion::FrameFusion& fusion, geometry::Cell cell) {
  return has_bit(fusion.low_and_tall(geometry::tile_of(cell)), cell);
}

inline std::vector<grid::TileBits> low_and_tall_of(const fusion::FrameFusion& fusion) {
  std::vector<grid::TileBits> tiles;
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    tiles.push_back(fusion.low_and_tall(tile));
  }
  return tiles;
}

}  // namespace iog::tests
