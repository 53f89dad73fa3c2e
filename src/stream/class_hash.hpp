// Computes the CRC that identifies a class grid by its content and position (docs/spec.md 3.10).
#pragma once

#include <cstddef>
#include <cstdint>

#include "stream/crc32.hpp"
#include "tile_coding/tile_cells.hpp"
#include "window/area.hpp"

namespace iog::stream {

// A CRC-32 over the window's corner coordinates a and b (both i32), followed by each tile with a
// classified cell. The tiles are ordered by tile number. For each tile, the CRC covers the tile
// number as u16 and then its 1024 cells. All integers are big endian. A grid without classes has a
// CRC of 0.
class ClassHash {
 public:
  explicit ClassHash(window::TileNumber corner = {});

  // Adds a tile that contains at least one classified cell. `number` is the tile's number in
  // messages (window/area.hpp).
  void add(std::size_t number, tile_coding::TileCells cells);
  // Adds a tile, given the CRC remainder of its cells (GridCrc32::remainder_of()).
  void add_remainder(std::size_t number, std::uint32_t remainder);

  [[nodiscard]] std::uint32_t value() const { return is_empty_ ? 0 : crc_.value(); }

 private:
  GridCrc32 crc_;
  bool is_empty_ = true;
};

}  // namespace iog::stream
