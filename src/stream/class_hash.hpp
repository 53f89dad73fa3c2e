// The name of a class grid: what it says, and where (docs/spec.md 3.10).
#pragma once

#include <cstddef>
#include <cstdint>

#include "stream/crc32.hpp"
#include "tile_coding/tile_cells.hpp"
#include "window/area.hpp"

namespace iog::stream {

// CRC-32 over the corner's a and b, each as i32, and the tiles of which a cell has a class, in the
// order of their numbers, each as its number, u16, and its 1024 cells; all big endian. A grid
// without classes has CRC 0.
class ClassHash {
 public:
  explicit ClassHash(window::TileNumber corner = {});

  // A tile of which a cell has a class. number: window::slot_of().
  void add(std::size_t number, tile_coding::TileCells cells);
  // The same of cells that have this remainder (checksum::FastCrc32::remainder_of()).
  void add_remainder(std::size_t number, std::uint32_t remainder);

  [[nodiscard]] std::uint32_t value() const { return is_empty_ ? 0 : crc_.value(); }

 private:
  void add_place(std::size_t number);

  Crc32 crc_;
  bool is_empty_ = true;
};

}  // namespace iog::stream
