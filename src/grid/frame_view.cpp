#include "grid/frame_view.hpp"

namespace iog::grid {

void FrameView::copy_cells(std::span<OccupancyIndex, geometry::kCellCount> to) const {
  for (std::size_t number = 0; number < geometry::kCellCount; ++number) {
    to[number] = grid_->at(geometry::cell_of(number));
  }
}

}  // namespace iog::grid
