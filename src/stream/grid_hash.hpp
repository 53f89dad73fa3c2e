// The name of a grid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "stream/crc32.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::stream {

// CRC-32 over the grid's known tiles in order of tile y, then tile x, each as u16 tile x and u16
// tile y, big endian, then its 1024 cells. A grid in which nothing is known has CRC 0.
class GridHash {
 public:
  void add(std::size_t tile_x, std::size_t tile_y,
           std::span<const std::byte, tile_coding::kTileBytes> tile);
  [[nodiscard]] std::uint32_t value() const { return crc_.value(); }

 private:
  Crc32 crc_;
};

}  // namespace iog::stream
