// Computes the CRC that identifies a grid.
#pragma once

#include <cstddef>
#include <cstdint>

#include "geometry/grid.hpp"
#include "stream/crc32.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::stream {

// A CRC-32 over the known tiles of the grid, sorted by tile y and then by tile x. For each tile,
// the CRC covers its x and y as big-endian u16 and then its 1024 cells. A grid without known cells
// has a CRC of 0.
class GridHash {
 public:
  explicit GridHash(const geometry::Grid& grid = {})
      : across_(grid.tiles_across()), row_end_(across_) {}

  // `tile` is the tile's number in row-major order. Tiles must be added in ascending order.
  void add(std::size_t tile, tile_coding::TileCells cells);
  // Adds a tile, given the CRC remainder of its cells (GridCrc32::remainder_of()).
  void add_remainder(std::size_t tile, std::uint32_t remainder);

  [[nodiscard]] std::uint32_t value() const { return crc_.value(); }

 private:
  std::size_t across_;   // tiles per row
  std::size_t row_end_;  // one past the last tile of the last tile's row
  std::size_t row_ = 0;
  GridCrc32 crc_;
};

}  // namespace iog::stream
