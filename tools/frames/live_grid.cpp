#include "tools/frames/live_grid.hpp"

#include <algorithm>

namespace iog::tools {

void LiveGrid::take(const GridFrame& frame) {
  if (frame.header.run_number != run_number_ || frame.shape != shape_) {
    forget();
    run_number_ = frame.header.run_number;
  }
  newest_frame_ = frame.header.frame_number;
  shape_ = frame.shape;
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (!frame.valid_tiles.test(tile)) {
      continue;
    }
    frame_of_.at(tile) = newest_frame_;
    if (tile < shape_.tile_count()) {
      put_tile(cells_of_tile(frame.cells, tile, shape_), tile, cells_, shape_);
    }
  }
}

void LiveGrid::forget() {
  frame_of_.fill(std::nullopt);
  std::ranges::fill(cells_, index::kUnknown);
}

std::optional<std::uint32_t> LiveGrid::age_of(std::size_t tile) const {
  const auto frame = frame_of_.at(tile);
  return frame ? std::optional(newest_frame_ - *frame) : std::nullopt;
}

std::size_t LiveGrid::stale_tiles() const {
  return static_cast<std::size_t>(std::ranges::count_if(
      frame_of_, [this](const auto& frame) { return frame != newest_frame_; }));
}

}  // namespace iog::tools
