// The true occupancy around the car, cell by cell of its grid.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "geometry/grid.hpp"
#include "tools/car/description.hpp"
#include "tools/simulate/world/solid.hpp"
#include "tools/simulate/world/traffic.hpp"

namespace iog::tools {

// One bool per cell of the memory (geometry/grid.hpp), row by row from the lowest y. A cell is
// occupied when its centre lies in the outline of a solid of which some height lies in the
// vehicle's height band. The car itself is not in it.
[[nodiscard]] std::vector<bool> true_occupancy(const EgoPose& ego, std::span<const Solid> solids,
                                               const description::Description& description);

// A PGM picture of the grid: 0 occupied, 255 free; x to the right, the row of highest y on top.
// UsageError if it cannot be written.
void write_truth(const std::string& path, const std::vector<bool>& occupied,
                 const geometry::Grid& grid);

}  // namespace iog::tools
