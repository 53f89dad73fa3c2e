// One bit for each cell of a tile, row by row.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

// Calls `visit(x)` for each bit that is set, lowest first.
template <typename Visit>
void for_each_bit(std::uint32_t bits, Visit visit) {
  for (; bits != 0; bits &= bits - 1) {
    visit(static_cast<std::size_t>(std::countr_zero(bits)));
  }
}

// The parts into which marks cut a tile, each a part of its own from a mark to the next.
struct Parts {
  std::size_t count = 0;
  std::size_t log2_sum = 0;  // of the cells of each part, rounded down
};

class CellMap {
 public:
  // The cells that differ from the cell before them in the tile; the first cell does not.
  void mark_changes(TileCells cells);

  // The cells that differ from the cell below them, in the row before; the first row does not.
  void mark_steps(TileCells cells);

  // The cells that differ from those of another tile.
  void mark_differences(TileCells cells, TileCells others);

  // Calls `visit(position)` for each marked cell, in order.
  template <typename Visit>
  void for_each(Visit visit) const {
    for (std::size_t y = 0; y < kTileSide; ++y) {
      for_each_bit(rows_[y], [&](std::size_t x) { visit(y * kTileSide + x); });
    }
  }

  // The first cell is not marked: it begins a part anyway.
  [[nodiscard]] Parts parts() const;

  // Bit x: cell x of row y.
  [[nodiscard]] std::uint32_t row(std::size_t y) const { return rows_[y]; }

 private:
  static_assert(kTileSide == 32, "a row of cells is a word of bits");

  using Rows = std::array<std::uint32_t, kTileSide>;

  alignas(16) Rows rows_{};
};

}  // namespace iog::tile_coding
