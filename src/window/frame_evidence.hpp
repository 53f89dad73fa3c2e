// The evidence of a frame in the window: what its slices say of each cell, joined.
//
// Free is pulled: a cell of the window takes the negative index of the vehicle's cell that holds
// its centre. Hits are pushed: a vehicle's cell with a positive index gives it to the cell of the
// window that holds its centre, because some cells of the vehicle's grid hold no centre (17 % at 45
// degrees), and a pole must not vanish. What lies outside of the window is dropped.
//
// A cell's evidence is the saturated sum of the positive indexes if there are any, else of the
// negative ones. A byte is enough for both: what is above zero counts hits alone, and the first hit
// erases what was pulled. Sums of one sign saturate alike in any order, so slices may come in any.
// The window bounds it all: a byte for each of its cells, by slot, 1 MB.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "window/area.hpp"
#include "window/placement.hpp"
#include "window/slice_cells.hpp"

namespace iog::window {

class FrameEvidence {
 public:
  using TileIndexes = std::array<std::int8_t, geometry::kTileCells>;

  // Adds a slice. The vehicle is inside of the area, which stays the same for a frame.
  void add(const SliceCells& slice, const Area& area, const Placement& at) {
    pull(slice, area, CellMap::to_grid(area, at));
    push(slice, area, CellMap::to_window(area, at));
  }

  // Nothing is said of any cell.
  void clear();

  // Whether anything was said of a cell of the tile at this slot.
  [[nodiscard]] bool is_touched(std::size_t slot) const { return is_touched_[slot]; }

  // Whether a cell of it was hit.
  [[nodiscard]] bool has_hit(std::size_t slot) const { return has_hit_[slot]; }

  // The joined indexes of the tile at a slot, row by row from the lowest y.
  [[nodiscard]] const TileIndexes& tile(std::size_t slot) const { return cells_[slot]; }

 private:
  void pull(const SliceCells& slice, const Area& area, const CellMap& map);
  void push(const SliceCells& slice, const Area& area, const CellMap& map);
  void push_tile(const SliceCells& slice, std::size_t tile, const Area& area, const CellMap& map);
  void push_eight(const std::int8_t* indexes, FinePoint first, FinePoint step, const Area& area);

  alignas(32) std::array<TileIndexes, kSlotCount> cells_{};
  std::array<bool, kSlotCount> is_touched_{};
  std::array<bool, kSlotCount> has_hit_{};
};

}  // namespace iog::window
