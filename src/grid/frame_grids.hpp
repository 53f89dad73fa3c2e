// The grids of a frame. `indexes` contains the occupancy index of each cell. If the vehicle's
// window uses heights, `heights` contains the cells that a low beam freed and the cells that a tall
// return hit (perception/opening.hpp).
//
// A beam is low where it is at most `low_m` above the ground. A tall return lies at least `tall_m`
// above the ground (docs/ground.md). A cell of `heights` is negative if a low beam freed it, and 1
// if a tall return hit it. Low beams carve `heights` just as all beams carve `indexes`. Hits are
// applied after all beams, and overwrite negative values in their cells. The result therefore does
// not depend on the order of the beams.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/grid.hpp"
#include "grid/block_grid.hpp"

namespace iog::grid {

// One bit per cell of a tile, row by row from the lowest y.
using TileBits = std::array<std::uint32_t, geometry::kTileSide>;
static_assert(geometry::kTileSide == 32);

struct FrameGrids {
  explicit FrameGrids(bool keep, const geometry::Grid& grid = {})
      : indexes(grid), heights(grid), keep_heights(keep) {}

  // Returns the tile's free cells that a low beam freed, together with its occupied cells that a
  // tall return hit.
  [[nodiscard]] TileBits low_and_tall(std::size_t tile) const;

  // Sets all cells of the tile to unknown and marks the tile as untouched.
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
