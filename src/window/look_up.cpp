#include "window/look_up.hpp"

namespace iog::window {

void pull_block(const SliceCells& slice, FinePoint first, FinePoint step, geometry::Cell /*low*/,
                geometry::Cell /*high*/, std::int8_t* evidence) {
  for (std::int32_t y = 0; y < SliceCells::kBlockSide; ++y) {
    FinePoint point = first;
    for (std::int32_t x = 0; x < SliceCells::kBlockSide; ++x) {
      evidence[x] = joined_free(evidence[x], slice.at(point.cell()));
      point = along_x(point, step);
    }
    first = along_y(first, step);
    evidence += kTileSide;
  }
}

}  // namespace iog::window
