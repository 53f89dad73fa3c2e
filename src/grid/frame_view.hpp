// A finished frame, as sinks, tools and measurements see it. It changes nothing, and
// is valid until the frame is cleared.
#pragma once

#include <cstddef>
#include <span>

#include "geometry/grid.hpp"
#include "grid/block_grid.hpp"

namespace iog::grid {

class FrameView {
 public:
  explicit FrameView(const BlockGrid& grid) : grid_(&grid) {}

  // The index of a cell of the grid.
  [[nodiscard]] OccupancyIndex at(geometry::Cell cell) const { return grid_->at(cell); }

  // All cells, row by row from the lowest y.
  void copy_cells(std::span<OccupancyIndex, geometry::kCellCount> to) const;

  // Whether something may be known in the tile.
  [[nodiscard]] bool is_touched(std::size_t tile) const { return grid_->is_touched(tile); }

  // The tile's cells, row by row from its lowest y. False if all of them are unknown.
  bool copy_tile(std::size_t tile, std::span<OccupancyIndex, geometry::kTileCells> to) const {
    return grid_->copy_tile(tile, to);
  }

 private:
  const BlockGrid* grid_;
};

}  // namespace iog::grid
