// The hits of a slice, each with the cell of the window that holds its cell's centre. Its tiles,
// bands of eight rows and rows are asked in turn whether there is one at all.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "geometry/cell.hpp"
#include "geometry/grid.hpp"
#include "window/eight_bytes.hpp"
#include "window/look_up.hpp"
#include "window/placement.hpp"
#include "window/reach.hpp"
#include "window/slice_cells.hpp"

namespace iog::window {

// Calls visit(cell, byte) for each hit of a band of eight rows, the first of which is at `row`.
template <typename Visit>
inline void for_each_hit_of_band(const std::int8_t* row, FinePoint at_row, FinePoint step,
                                 Visit& visit) {
  constexpr std::int32_t kEight = EightBytes::kCount;
  const FinePoint eight_steps{kEight * step.x, kEight * step.y};
  for (std::int32_t y = 0; y < SliceCells::kBlockSide; ++y, row += geometry::kTileSide) {
    FinePoint at = at_row;
    for (std::size_t x = 0; x < geometry::kTileSide; x += kEight) {
      const auto eight = EightBytes::load(row + x);
      if (eight.has_positive()) {
        for (std::uint32_t left = eight.positive(); left != 0; left &= left - 1) {
          const int i = std::countr_zero(left);
          visit(FinePoint{at.x + i * step.x, at.y + i * step.y}.cell(), row[x + std::size_t(i)]);
        }
      }
      at = along_x(at, eight_steps);
    }
    at_row = along_y(at_row, step);
  }
}

// Cells are counted from the window's lowest, and may lie outside of it. Tiles and bands of which
// meets(low, high) says that none of the cells between those two matters are left out.
template <typename Meets, typename Visit>
inline void for_each_hit(const SliceCells& slice, const CellMap& to_window, Meets&& meets,
                         Visit&& visit) {
  constexpr auto kTiles = static_cast<std::int32_t>(geometry::kTilesPerSide);
  constexpr std::int32_t kRows = std::int32_t{kBandRows};
  const FinePoint step = to_window.step();
  const Reach of_tile = Reach::of_square(kTileSide, step);
  const Reach of_band = Reach::of(kTileSide, kRows, step);
  for (const std::uint16_t tile : slice.hit_tiles()) {
    FinePoint first = to_window.exact({tile % kTiles * kTileSide, tile / kTiles * kTileSide});
    if (!meets(of_tile.low(first), of_tile.high(first))) {
      continue;
    }
    const std::int8_t* row = slice.cells({tile % kTiles, tile / kTiles}).data();
    for (std::size_t band = 0; band < geometry::kTileSide / kBandRows; ++band) {
      if (slice.may_be_hit(tile, band) && meets(of_band.low(first), of_band.high(first))) {
        for_each_hit_of_band(row, first, step, visit);
      }
      row += kBandCells;
      first = {first.x - kRows * step.y, first.y + kRows * step.x};
    }
  }
}

}  // namespace iog::window
