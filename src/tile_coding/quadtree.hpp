// A tile as a quadtree: blocks of one value, in Morton order.
//
//   u8        number of values
//   int8 ...  the values
//   bits      the tree, a node before its children, these in the order of lowest x and y, then of
//             higher x, of higher y, of both: 1 for a block that is split, 0 and its value's number
//             for one that is not, the number alone for a single cell
//   bits      zeros up to the next byte
//
// Of n values a number has ceil(log2 n) bits.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "tile_coding/cell_map.hpp"
#include "tile_coding/palette.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

// Where cell m of the Morton order is in a tile, row by row: bits 0, 2, 4 ... of m are those of x.
[[nodiscard]] std::size_t cell_of_morton(std::size_t m);

class Quadtree {
 public:
  static constexpr std::size_t kLevels = kTileSideLog2;

  // Finds the tree of the tile with these changes and steps.
  void find(const CellMap& changes, const CellMap& steps);

  // The bytes of the code if the tile has `value_count` values.
  [[nodiscard]] std::size_t coded_bytes(std::size_t value_count) const;

  // Writes the code of the cells that were found. `palette` has all their values and no other.
  // Returns the bytes written, or 0 if they do not fit.
  std::size_t write(TileCells cells, Palette& palette, std::span<std::byte> buffer) const;

 private:
  // Bit x of row y: the block of 2^level by 2^level cells whose lowest cell is x of row y 2^level
  // has more than one value.
  using BlockRows = std::array<std::uint32_t, kTileSide / 2>;

  // `cell` is the lowest one of the block.
  [[nodiscard]] bool is_split(std::size_t level, std::size_t cell) const {
    const std::uint32_t row = split_[level - 1][cell / kTileSide >> level];
    return ((row >> (cell % kTileSide)) & 1U) != 0;
  }

  std::array<BlockRows, kLevels> split_{};  // of level 1 ... 5
  std::array<std::size_t, kLevels> split_count_{};
};

}  // namespace iog::tile_coding
