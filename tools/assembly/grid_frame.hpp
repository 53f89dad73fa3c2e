// A frame as a receiver has put it together from its messages.
#pragma once

#include <bitset>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/frame_fusion.hpp"
#include "stream/message.hpp"
#include "stream/tile.hpp"

namespace iog::tools {

struct GridFrame {
  // Among the frames with evidence, from 0; meaningless in a frame without.
  std::uint64_t evidence_number = 0;
  stream::Header header;  // of its last message, or of a tile if that is lost
  stream::FrameEnd end;   // only if has_end
  bool has_end = false;
  std::uint32_t tiles = 0;                      // that have arrived
  std::bitset<stream::kTileCount> known_tiles;  // by y * kTilesPerSide + x
  // Row by row from the lowest y; a cell of a tile that has not come is unknown.
  std::vector<index::OccupancyIndex> cells =
      std::vector<index::OccupancyIndex>(grid::kCellCount, index::kUnknown);

  // Everything that the target knows has arrived.
  [[nodiscard]] bool is_whole() const {
    return has_end && end.tiles_lost == 0 && tiles == end.tiles_sent;
  }
  [[nodiscard]] std::span<const index::OccupancyIndex, grid::kCellCount> grid() const {
    return std::span(cells).first<grid::kCellCount>();
  }
};

// The name of the grid as it has arrived; that of the whole frame is end.grid_crc.
[[nodiscard]] std::uint32_t grid_crc_of(const GridFrame& frame);

}  // namespace iog::tools
