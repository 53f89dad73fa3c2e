// Carving: makes the cells of a line freer, as the steps of its beams say.
#pragma once

#include <cstdint>

#include "grid/block_grid.hpp"
#include "grid/block_path.hpp"
#include "grid/free_steps.hpp"

namespace iog::grid {

// Carves block by block along the path, which is extended as far as the steps reach. All steps lie
// in the grid. The tiles of the path are touched. Nothing waits in the steps then.
void carve_blocks(BlockGrid& grid, BlockPath& path, FreeSteps& steps);
// The same of steps with gaps, whose blocks are passed.
void carve_blocks(BlockGrid& grid, BlockPath& path, LowSteps& steps);

// Does the same cell by cell, for any line. It is the specification of the other. first: the line's
// first position in the grid.
void carve_cells(BlockGrid& grid, const vehicle::BeamLine& line, traversal::Position first,
                 FreeSteps& steps);

}  // namespace iog::grid
