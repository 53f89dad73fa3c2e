// Carving subtracts the steps of a line's beams from the indexes of the line's cells.
#pragma once

#include <cstdint>

#include "grid/block_grid.hpp"
#include "grid/block_path.hpp"
#include "grid/free_steps.hpp"

namespace iog::grid {

// Carves block by block along the path, and extends the path as far as the steps reach. All steps
// must lie in the grid. Marks the tiles of the path as touched and clears the steps.
void carve_blocks(BlockGrid& grid, BlockPath& path, FreeSteps& steps);
// Same as above, for steps with gaps. Blocks within a gap are skipped.
void carve_blocks(BlockGrid& grid, BlockPath& path, LowSteps& steps);

// Carves cell by cell, along any line. This function is the specification of carve_blocks().
// `first` is the line's first position in the grid.
void carve_cells(BlockGrid& grid, const vehicle::BeamLine& line, traversal::Position first,
                 FreeSteps& steps);

}  // namespace iog::grid
