// The grids of a frame: the occupancy index of each cell and, if the vehicle's window needs them,
// the heights at which beams freed or hit the cell (perception/opening.hpp).
//
// A beam is low where it runs at most `low_m` above the ground. A return is tall if it lies at
// least `tall_m` above the ground (docs/ground.md). A cell of `heights` is below 0 if a low beam
// freed it, and 1 if a tall return hit it. Low beams are carved into `heights` like all beams. Hits
// are applied after all beams, and leave no value below 0. So the result does not depend on the
// order.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/grid.hpp"
#include "grid/block_grid.hpp"

namespace iog::grid {

// One bit per cell of a tile, row by row from its lowest y.
using TileBits = std::array<std::uint32_t, geometry::kTileSide>;
static_assert(geometry::kTileSide == 32);

struct FrameGrids {
  explicit FrameGrids(bool keep) : keep_heights(keep) {}

  // The cells of a tile that are free and were freed by a low beam, and those that are occupied and
  // were hit by a tall return.
  [[nodiscard]] TileBits low_and_tall(std::size_t tile) const;

  // Sets all cells of the tile to unknown, and the tile to untouched.
  void clear_tile(std::size_t tile) {
    indexes.clear_tile(tile);
    if (heights.is_touched(tile)) {
      heights.clear_tile(tile);
    }
  }

  BlockGrid indexes;
  BlockGrid heights;
  bool keep_heights;
};

}  // namespace iog::grid
