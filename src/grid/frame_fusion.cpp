#include "grid/frame_fusion.hpp"

namespace iog::grid {

// What points that wait will mark nobody knows until they are carved. Mostly there is room for all
// that can wait.
bool FrameFusion::fits(const vehicle::Sensor& sensor, std::uint32_t points) {
  const std::uint64_t needed = std::uint64_t{points} * max_marks_per_point(sensor);
  if (needed + carver_.most_marks_waiting() > kMaxMarks - marks_.count()) {
    carver_.carve_waiting();
  }
  return needed <= kMaxMarks - marks_.count();
}

void FrameFusion::finish() {
  carver_.carve_waiting();
  marks_.apply(grid_, rule_);
}

void FrameFusion::clear() {
  carver_.drop_waiting();
  marks_.clear();
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (grid_.is_touched(tile)) {
      grid_.clear_tile(tile);
    }
  }
}

}  // namespace iog::grid
