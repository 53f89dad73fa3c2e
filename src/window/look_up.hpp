// Opening up what a square of the window's cells finds in the vehicle's grid. look_up.cpp says
// what; CMake chooses how, look_up.cpp or look_up_arm.cpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "window/placement.hpp"
#include "window/slice_cells.hpp"

namespace iog::window {

// Eight rows of a tile.
inline constexpr std::size_t kBandRows = SliceCells::kBlockSide;
inline constexpr std::size_t kBandCells = kBandRows * geometry::kTileSide;
using Band = std::array<std::int8_t, kBandCells>;

// Writes the indexes of kBlockSide by kBlockSide cells from column x on, a multiple of kBlockSide.
// The first one's centre lies at `first` in the grid, and all are inside of it. The band is aligned
// to 8 bytes.
void look_up_block(const SliceCells& slice, FinePoint first, FinePoint step, std::size_t x,
                   Band& band);

}  // namespace iog::window
