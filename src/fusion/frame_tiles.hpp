// Stores the tiles that result from fusing one part of a frame. The cells of each tile are stored
// row by row, separately from the grid in which they were fused. A core uses these tiles to pass
// its results to the other cores.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "fusion/frame_fusion.hpp"
#include "geometry/grid.hpp"
#include "index/occupancy_index.hpp"

namespace iog::fusion {

class FrameTiles {
 public:
  using TileIndexes = std::span<const index::OccupancyIndex, geometry::kTileCells>;

  // Moves the grid out of a finished FrameFusion, and leaves the FrameFusion empty. Overwrites all
  // previous content of this object.
  void move_from(FrameFusion& fusion) {
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (fusion.keeps_heights()) {
        low_and_tall_[tile] = fusion.low_and_tall(tile);
      }
      is_known_[tile] = fusion.take_tile(tile, tiles_[tile]);
    }
  }

  // `is_known()` returns true if the tile has at least one known cell. `tile()` returns the indexes
  // of a known tile.
  [[nodiscard]] bool is_known(std::size_t tile) const { return is_known_[tile]; }
  [[nodiscard]] TileIndexes tile(std::size_t tile) const { return tiles_[tile]; }
  // Returns the cells that were freed by a low beam or hit by a tall return (grid/frame_grids.hpp).
  [[nodiscard]] const grid::TileBits& low_and_tall(std::size_t tile) const {
    return low_and_tall_[tile];
  }

 private:
  std::array<bool, geometry::kTileCount> is_known_{};
  alignas(32) std::array<std::array<index::OccupancyIndex, geometry::kTileCells>,
                         geometry::kTileCount> tiles_{};
  std::array<grid::TileBits, geometry::kTileCount> low_and_tall_{};
};

}  // namespace iog::fusion
