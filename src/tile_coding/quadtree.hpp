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

#include "tile_coding/palette.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

// Where cell m of the Morton order is in a tile, row by row: bits 0, 2, 4 ... of m are those of x.
[[nodiscard]] std::size_t cell_of_morton(std::size_t m);

class Quadtree {
 public:
  // No cell is -128.
  void find(TileCells cells);

  // The bytes of the code if the tile has `value_count` values.
  [[nodiscard]] std::size_t coded_bytes(std::size_t value_count) const;

  // Writes the code of the cells that were found. `palette` has all their values and no other.
  // Returns the bytes written, or 0 if they do not fit.
  static constexpr std::size_t kLevels = kTileSideLog2;
  std::size_t write(TileCells cells, Palette& palette, std::span<std::byte> buffer) const;

 private:
  // Bit m of level k (from 1): block m, of 2^k by 2^k cells, has more than one value.
  class BlockMap {
   public:
    void clear() { words_ = {}; }
    void set(std::size_t block, std::uint32_t bits) { words_[block / 32] |= bits << (block % 32); }
    [[nodiscard]] bool test(std::size_t block) const {
      return ((words_[block / 32] >> (block % 32)) & 1U) != 0;
    }
    // Whether one of blocks 4 b ... 4 b + 3 is set.
    [[nodiscard]] bool any_child(std::size_t b) const {
      return ((words_[b / 8] >> (b % 8 * 4)) & 0xFU) != 0;
    }

   private:
    std::array<std::uint32_t, kTileBytes / 4 / 32> words_{};
  };

  // Each returns the number of blocks that are split.
  std::size_t find_level_1(TileCells cells);
  std::size_t find_level(std::size_t level, TileCells cells);

  std::array<BlockMap, kLevels> split_;  // of level 1 ... 5
  std::array<std::size_t, kLevels> split_count_{};
};

}  // namespace iog::tile_coding
