// Grids that no drive makes, drawn to be hard on a quadtree, or easy.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "index/occupancy_index.hpp"

namespace iog::lab {

struct NamedGrid {
  std::string name;
  std::vector<index::OccupancyIndex> cells;  // row by row, geometry::kCellCount of them
};

// One index everywhere, single cells, and last a checkerboard: no tree can have more leaves.
[[nodiscard]] std::vector<NamedGrid> drawn_grids(std::uint64_t seed);

}  // namespace iog::lab
