#include "tools/frames/grid_frame.hpp"

#include <cstring>

#include "stream/grid_hash.hpp"

namespace iog::tools {

std::vector<index::OccupancyIndex> cells_in_grid(const GridFrame& frame) {
  std::vector<index::OccupancyIndex> cells;
  cells.reserve(std::size_t{frame.shape.columns} * frame.shape.rows);
  for (std::int32_t y = 0; y < frame.shape.rows; ++y) {
    const auto row = std::span(frame.cells)
                         .subspan(static_cast<std::size_t>(geometry::number_of({0, y})))
                         .first(frame.shape.columns);
    cells.insert(cells.end(), row.begin(), row.end());
  }
  return cells;
}

std::array<std::byte, tile_coding::kTileBytes> cells_of_tile(std::span<const std::int8_t> grid,
                                                             std::size_t tile) {
  std::array<std::byte, tile_coding::kTileBytes> cells{};
  for (std::size_t row = 0; row < cells.size(); row += geometry::kTileSide) {
    std::memcpy(&cells[row], &grid[cell_of_tile(tile, row)], geometry::kTileSide);
  }
  return cells;
}

void put_tile(std::span<const std::byte, tile_coding::kTileBytes> cells, std::size_t tile,
              std::span<std::int8_t> grid) {
  for (std::size_t row = 0; row < cells.size(); row += geometry::kTileSide) {
    std::memcpy(&grid[cell_of_tile(tile, row)], &cells[row], geometry::kTileSide);
  }
}

std::uint32_t grid_crc_of(const GridFrame& frame) {
  stream::GridHash hash;
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (frame.known_tiles.test(tile)) {
      hash.add(tile, cells_of_tile(frame.cells, tile));
    }
  }
  return hash.value();
}

}  // namespace iog::tools
