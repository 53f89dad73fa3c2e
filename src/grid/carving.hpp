// Carving subtracts the steps of a line's beams from the indexes of the line's cells.
#pragma once

#include <cstdint>

#include "grid/block_grid.hpp"
#include "grid/block_path.hpp"
#include "grid/free_steps.hpp"

namespace iog::grid {

// Carves block by block along the path, marks the tiles of the path as touched, and clears the
// steps. If the steps extend beyond the known path, the function also extends the path. All steps
// must lie in the grid.
void carve_blocks(BlockGrid& grid, BlockPath& path, FreeSteps& steps);
// Does the same for steps with gaps, and skips the blocks within a gap.
void carve_blocks(BlockGrid& grid, BlockPath& path, LowSteps& steps);

// Carves cell by cell, along any line. This function is the reference for carve_blocks(). `first`
// is the position where the line enters the grid.
void carve_cells(BlockGrid& grid, const vehicle::BeamLine& line, traversal::Position first,
                 FreeSteps& steps);

}  // namespace iog::grid
