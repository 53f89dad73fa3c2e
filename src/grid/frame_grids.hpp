// The grids of a frame: the occupancy index of each cell and, if the vehicle's window needs it,
// whether a low beam freed the cell or a tall return hit it (perception/opening.hpp).
//
// A beam is low where it is at most `low_m` above the ground. A tall return lies at least `tall_m`
// above the ground (docs/ground.md). A cell of `heights` is negative if a low beam freed the cell,
// and 1 if a tall return hit it. Low beams are carved into `heights` in the same way as beams are
// carved into the indexes. Hits are applied after all beams, and overwrite every negative value in
// their cells. The result therefore does not depend on the order of the beams.
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

  // Returns the free cells of a tile that were freed by a low beam, and the occupied cells that
  // were hit by a tall return.
  [[nodiscard]] TileBits low_and_tall(std::size_t tile) const;

  // Sets all cells of the tile to unknown, and marks the tile as untouched.
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
