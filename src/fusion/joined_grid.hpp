// A grid that is assembled from several index grids. The joined grid is the same as if all evidence
// in these grids had been fused at once with `hits_win`.
//
// The index of a cell is the saturating sum of the cell's positive indexes in all grids. If no
// index is positive, the index of the cell is the saturating sum of the negative indexes
// (docs/model.md section 3). The saturating sum of numbers with the same sign does not depend on
// the order of summation. A frame can therefore be split in any way. Fusing each part from zero
// with `hits_win` and joining the parts gives the same result as fusing the entire frame at once.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "geometry/grid.hpp"
#include "grid/frame_grids.hpp"
#include "index/occupancy_index.hpp"

namespace iog::fusion {

// Adds the indexes of a tile to the indexes of the same tile in another grid.
void join(std::span<index::OccupancyIndex, geometry::kTileCells> to,
          std::span<const index::OccupancyIndex, geometry::kTileCells> more);

// Joins the bits (grid/frame_grids.hpp) that two grids store for the same tile. If a cell is hit in
// only one of the grids, the cell's bit is taken from that grid. Otherwise, the cell's two bits are
// combined with OR.
[[nodiscard]] grid::TileBits join(
    std::span<const index::OccupancyIndex, geometry::kTileCells> one,
    const grid::TileBits& bits_of_one,
    std::span<const index::OccupancyIndex, geometry::kTileCells> other,
    const grid::TileBits& bits_of_other);

class JoinedGrid {
 public:
  using TileIndexes = std::span<const index::OccupancyIndex, geometry::kTileCells>;

  // Adds a tile of a grid. The indexes are stored row by row from the lowest y. The tile must have
  // at least one known cell.
  void add(std::size_t tile, TileIndexes indexes);

  // Sets the tile to unknown.
  void forget(std::size_t tile) { is_known_[tile] = false; }

  // Visits the tiles of the grid and then clears the grid, as FrameFusion::release() does.
  template <typename Visit>
  void release(Visit&& visit) {
    for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
      if (is_known_[tile]) {
        is_known_[tile] = false;
        visit(tile, std::as_bytes(std::span(tiles_[tile])));
      }
    }
  }

 private:
  // A tile is known as soon as one of its cells is known, because a sum of numbers with the same
  // sign is never 0. If a tile is unknown, its stored cells are meaningless.
  std::array<bool, geometry::kTileCount> is_known_{};
  alignas(32) std::array<std::array<index::OccupancyIndex, geometry::kTileCells>,
                         geometry::kTileCount> tiles_{};
};

}  // namespace iog::fusion
