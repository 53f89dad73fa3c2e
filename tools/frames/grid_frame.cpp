#include "tools/frames/grid_frame.hpp"

#include <cstring>

#include "stream/grid_hash.hpp"

namespace iog::tools {

std::vector<index::OccupancyIndex> cells_in_grid(const GridFrame& frame) {
  const auto cells = std::span(frame.cells).first(frame.shape.tile_count() * geometry::kTileCells);
  return {cells.begin(), cells.end()};
}

std::array<std::byte, tile_coding::kTileBytes> cells_of_tile(std::span<const std::int8_t> cells,
                                                             std::size_t tile,
                                                             const geometry::Grid& grid) {
  std::array<std::byte, tile_coding::kTileBytes> of_tile{};
  for (std::size_t row = 0; row < of_tile.size(); row += geometry::kTileSide) {
    std::memcpy(&of_tile[row], &cells[cell_of_tile(tile, row, grid)], geometry::kTileSide);
  }
  return of_tile;
}

void put_tile(std::span<const std::byte, tile_coding::kTileBytes> tile_cells, std::size_t tile,
              std::span<std::int8_t> cells, const geometry::Grid& grid) {
  for (std::size_t row = 0; row < tile_cells.size(); row += geometry::kTileSide) {
    std::memcpy(&cells[cell_of_tile(tile, row, grid)], &tile_cells[row], geometry::kTileSide);
  }
}

std::uint32_t grid_crc_of(const GridFrame& frame) {
  stream::GridHash hash(frame.shape);
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (frame.known_tiles.test(tile)) {
      hash.add(tile, cells_of_tile(frame.cells, tile, frame.shape));
    }
  }
  return hash.value();
}

}  // namespace iog::tools
