// The grids that a frame's beams change: the occupancy index of each cell and, if the vehicle's
// window asks for it, what is known of the heights at which beams freed and hit the cell
// (perception/opening.hpp).
//
// A cell of `heights` is below 0 if a beam that was low has freed it, and 1 if it is hit by a
// return that is tall. Beams that are low are carved into it as beams are carved, and hits, which
// come after all beams, leave nothing below 0. So no order shows.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/grid.hpp"
#include "grid/block_grid.hpp"

namespace iog::grid {

// A bit for each cell of a tile, row by row from its lowest y.
using TileBits = std::array<std::uint32_t, geometry::kTileSide>;
static_assert(geometry::kTileSide == 32);

struct FrameGrids {
  explicit FrameGrids(bool keep) : keep_heights(keep) {}

  // Of a tile: the cells that are free and were freed from below, and those that are hit and tall.
  [[nodiscard]] TileBits low_and_tall(std::size_t tile) const;

  // All cells of the tile back to unknown, and untouched.
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
