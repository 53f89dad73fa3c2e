#include "window/look_up.hpp"

namespace iog::window {

void look_up_block(const SliceCells& slice, FinePoint first, FinePoint step, std::size_t x,
                   Band& band) {
  constexpr std::int32_t kStride = SliceCells::kStride;
  for (std::size_t row = x; row < band.size(); row += geometry::kTileSide) {
    FinePoint point = first;
    for (std::size_t i = row; i < row + SliceCells::kBlockSide; ++i) {
      const geometry::Cell cell = point.cell();
      band[i] = slice.cells()[cell.y * kStride + cell.x];
      point = along_x(point, step);
    }
    first = along_y(first, step);
  }
}

}  // namespace iog::window
