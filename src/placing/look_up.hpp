// Pulling what the window's cells find free in the vehicle's grid. look_up.cpp says what; CMake
// chooses how, look_up.cpp or look_up_neon.cpp.
#pragma once

#include <cstdint>
#include <span>

#include "placing/eight_steps.hpp"
#include "placing/placement.hpp"
#include "placing/slice_cells.hpp"

namespace iog::placing {

// Adds to the evidence of a tile what its cells find free (placing/slice_byte.hpp). The first one's
// centre lies at `first` in the grid, the others' by `steps`. False if nothing is known near.
bool pull_tile(const SliceCells& slice, FinePoint first, const EightSteps& steps,
               std::span<std::int8_t, geometry::kTileCells> evidence);

}  // namespace iog::placing
