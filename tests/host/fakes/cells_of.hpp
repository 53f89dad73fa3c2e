// The grid of a fusion as one array, cell by cell.
#pragma once

#include <span>
#include <vector>

#include "fusion/frame_fusion.hpp"

namespace iog::tests {

inline std::vector<grid::OccupancyIndex> cells_of(const fusion::FrameFusion& fusion) {
  std::vector<grid::OccupancyIndex> cells(geometry::kCellCount);
  fusion.view().copy_cells(std::span(cells).first<geometry::kCellCount>());
  return cells;
}

}  // namespace iog::tests
