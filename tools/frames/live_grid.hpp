// What a receiver knows of the grid at any moment: the last state of each tile that arrived, and
// how old it is. A tile whose newest state was lost is stale and is never shown as fresh.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

class LiveGrid {
 public:
  // The next frame, in order, as FrameAssembler hands them over. Of another run or grid nothing is
  // kept.
  void take(const GridFrame& frame);

  // To be called when the target has been silent: nothing that is known is of now.
  void forget();

  // How many frames older than the newest frame the tile's cells are; 0 is fresh. Nothing if the
  // tile has never arrived.
  [[nodiscard]] std::optional<std::uint32_t> age_of(std::size_t tile) const;

  [[nodiscard]] std::size_t stale_tiles() const;  // older than the newest frame, or never arrived
  [[nodiscard]] std::uint32_t newest_frame() const { return newest_frame_; }
  [[nodiscard]] std::uint32_t run_number() const { return run_number_; }

  [[nodiscard]] const geometry::Grid& shape() const { return shape_; }  // of the newest frame
  // The grid row by row from the lowest y; a cell of a tile that has never arrived is 0.
  [[nodiscard]] std::span<const index::OccupancyIndex> cells() const { return cells_; }

 private:
  std::vector<index::OccupancyIndex> cells_ =
      std::vector<index::OccupancyIndex>(geometry::kCellCount, index::kUnknown);
  std::array<std::optional<std::uint32_t>, geometry::kTileCount> frame_of_{};
  geometry::Grid shape_;
  std::uint32_t newest_frame_ = 0;
  std::uint32_t run_number_ = 0;
};

}  // namespace iog::tools
