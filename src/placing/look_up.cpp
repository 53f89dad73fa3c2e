#include "placing/look_up.hpp"

#include "placing/known_blocks.hpp"

namespace iog::placing {

bool pull_tile(const SliceCells& slice, FinePoint first, const EightSteps& steps,
               std::span<std::int8_t, geometry::kTileCells> evidence) {
  return for_each_known_block(
      slice, slice.shape(), first, steps.step, evidence,
      [&](FinePoint row, geometry::Cell /*low*/, geometry::Cell /*high*/, std::int8_t* cells) {
        for (std::int32_t y = 0; y < SliceCells::kBlockSide; ++y) {
          FinePoint point = row;
          for (std::int32_t x = 0; x < SliceCells::kBlockSide; ++x) {
            cells[x] = joined_free(cells[x], slice.at(point.cell()));
            point = along_x(point, steps.step);
          }
          row = along_y(row, steps.step);
          cells += window::kTileSide;
        }
      });
}

}  // namespace iog::placing
