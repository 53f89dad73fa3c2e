// Pulling what a square of the window's cells finds free in the vehicle's grid. look_up.cpp says
// what; CMake chooses how, look_up.cpp or look_up_neon.cpp.
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

// Eight by eight cells reach 7 sqrt(2) cells far, and so are within a square of 11.
inline constexpr std::int32_t kBlockReach = 11;
static_assert(kBlockReach <= SliceCells::kMostNear);

// Adds to the evidence of kBlockSide by kBlockSide cells what they find free
// (window/slice_byte.hpp). The first one's centre lies at `first` in the grid; all of them are from
// `low` to `high`, anywhere. The evidence is that of the first of eight rows of a tile, and aligned
// to 8 bytes.
void pull_block(const SliceCells& slice, FinePoint first, FinePoint step, geometry::Cell low,
                geometry::Cell high, std::int8_t* evidence);

}  // namespace iog::window
