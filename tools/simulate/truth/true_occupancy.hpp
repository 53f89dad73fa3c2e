// The true occupancy around the car, cell by cell of its grid.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "geometry/grid.hpp"
#include "tools/car/description.hpp"
#include "tools/simulate/world/solid.hpp"
#include "tools/simulate/world/traffic.hpp"

namespace iog::tools {

// One bool per cell of the memory (geometry/grid.hpp), row by row from the lowest y. A cell is
// occupied if its centre is inside the outline of a solid that extends into the vehicle's height
// band. The car itself is not included.
[[nodiscard]] std::vector<bool> true_occupancy(const EgoPose& ego, std::span<const Solid> solids,
                                               const description::Description& description);

// Makes the folder of pictures truth_NNNNNN.pgm, and removes those of an earlier run. UsageError,
// and nothing is removed, if one of them is not iog's.
void make_truth_folder(const std::string& folder);

// Writes a PGM picture of the grid: 0 is occupied, 255 is free, x points right, and the row of
// highest y is at the top. UsageError if it cannot be written.
void write_truth(const std::string& path, const std::vector<bool>& occupied,
                 const geometry::Grid& grid);

}  // namespace iog::tools
