#include "fusion/frame_fusion.hpp"

namespace iog::fusion {

void FrameFusion::finish() {
  carve_waiting();
  marks_.apply(grids_, rule_);
}

void FrameFusion::clear() {
  azimuths_.drop_waiting();
  turns_.drop_waiting();
  marks_.clear();
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (grids_.indexes.is_touched(tile)) {
      grids_.clear_tile(tile);
    }
  }
}

}  // namespace iog::fusion
