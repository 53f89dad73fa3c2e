// One bit for each cell of a tile, row by row.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

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
    for (std::size_t row = 0; row < kTileSide; ++row) {
      for (std::uint32_t bits = rows_[row]; bits != 0; bits &= bits - 1) {
        visit(row * kRowBits + static_cast<std::size_t>(std::countr_zero(bits)));
      }
    }
  }

  // Bit x: cell x of row y.
  [[nodiscard]] std::uint32_t row(std::size_t y) const { return rows_[y]; }

  // The first marked cell at or after `position` <= kTileBytes; kTileBytes if there is none.
  [[nodiscard]] std::size_t next(std::size_t position) const {
    std::size_t row = position / kRowBits;
    std::uint32_t bits = rows_[row] >> (position % kRowBits);
    if (bits != 0) {
      return position + static_cast<std::size_t>(std::countr_zero(bits));
    }
    do {
      ++row;
    } while (rows_[row] == 0);
    return row * kRowBits + static_cast<std::size_t>(std::countr_zero(rows_[row]));
  }

 private:
  static constexpr std::size_t kRowBits = 32;
  static_assert(kTileSide == kRowBits);

  // Bit x of a row is its cell x. The row behind the last one is marked, so that a search ends.
  std::array<std::uint32_t, kTileSide + 1> rows_{};
};

}  // namespace iog::tile_coding
