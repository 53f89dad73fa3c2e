#include "tools/receive/grid_frame.hpp"

#include "stream/grid_hash.hpp"

namespace iog::tools {

std::array<std::byte, tile_coding::kTileBytes> cells_of_tile(const GridFrame& frame,
                                                             std::size_t tile) {
  std::array<std::byte, tile_coding::kTileBytes> cells{};
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = static_cast<std::byte>(frame.cells[cell_of_tile(tile, i)]);
  }
  return cells;
}

std::uint32_t grid_crc_of(const GridFrame& frame) {
  stream::GridHash hash;
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (frame.known_tiles.test(tile)) {
      hash.add(tile % geometry::kTilesPerSide, tile / geometry::kTilesPerSide,
               cells_of_tile(frame, tile));
    }
  }
  return hash.value();
}

}  // namespace iog::tools
