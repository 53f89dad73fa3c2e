// The linear quadtree of one tile: 32 by 32 cells, the depths from a tile down to its cells.
//
// A tile is four quarters of 16 by 16 cells. A quarter has one bit for each of its blocks of 8, 4
// and 2 cells a side, in Morton order: whether the block is split. Below a block that is not split
// all bits are 0. The indexes of the leaves are kept beside the shape, one byte each, in Morton
// order.
//
// A split makes four leaves of one, three more than before. So the number of leaves before a block
// is three times the splits before it, plus the block's own number among its siblings, plus that of
// each block around it. Random access therefore counts bits and follows no pointer.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/tile.hpp"

namespace iog::tree {

using geometry::kTileCells;
using geometry::kTileSide;
using geometry::kTileSideLog2;
inline constexpr std::uint32_t kQuarterSideLog2 = kTileSideLog2 - 1;
inline constexpr std::uint32_t kQuarterCells = kTileCells / 4;

// Which leaf of a quarter: its number, and the side of its block.
struct QuarterLeaf {
  std::uint32_t number = 0;
  std::uint32_t side_log2 = 0;
};

struct QuarterShape {
  std::array<std::uint32_t, 2> split_2{};  // bit i of word w: the (32 w + i)-th block of 2 by 2
  std::uint16_t split_4 = 0;
  std::uint8_t split_8 = 0;
  std::uint8_t last_leaf = 0;  // the number of leaves less 1; 0 if the quarter is not split

  [[nodiscard]] std::uint32_t leaves() const { return last_leaf + 1U; }

  // The side of the leaf that holds the cell at this place, in Morton order, of the quarter.
  [[nodiscard]] std::uint32_t side_log2_at(std::uint32_t place) const {
    if (last_leaf == 0) {
      return kQuarterSideLog2;
    }
    if ((split_8 >> (place >> 6) & 1U) == 0) {
      return 3;
    }
    if ((split_4 >> (place >> 4) & 1U) == 0) {
      return 2;
    }
    return (split_2[place >> 7] >> (place >> 2 & 31U) & 1U) == 0 ? 1 : 0;
  }

  // The leaf that holds the cell at this place.
  [[nodiscard]] QuarterLeaf leaf_at(std::uint32_t place) const {
    const std::uint32_t side_log2 = side_log2_at(place);
    std::uint32_t number = 3 * splits_before(place);
    for (std::uint32_t side = side_log2; side < kQuarterSideLog2; ++side) {
      number += place >> (2 * side) & 3U;
    }
    return {number, side_log2};
  }

 private:
  static constexpr std::uint32_t count_below(std::uint32_t bits, std::uint32_t end) {
    return static_cast<std::uint32_t>(std::popcount(bits & ((1U << end) - 1)));
  }

  // Split blocks that end before a place.
  [[nodiscard]] std::uint32_t splits_before(std::uint32_t place) const {
    const std::uint32_t whole = place >> 7 == 0 ? 0 : split_2[0];
    return count_below(split_8, place >> 6) + count_below(split_4, place >> 4) +
           static_cast<std::uint32_t>(std::popcount(whole)) +
           count_below(split_2[place >> 7], place >> 2 & 31U);
  }
};
static_assert(sizeof(QuarterShape) == 12);

using TileShape = std::array<QuarterShape, 4>;

// The cells of a tile, row by row from its lowest y, each int8 as one byte.
using TileCells = std::span<const std::byte, kTileCells>;

// Where the leaves of a tile are written: up to 1024, and after the last one up to three bytes
// without meaning, because four are written at a time.
inline constexpr std::size_t kLeafSlack = 3;
using TileLeaves = std::span<std::byte, kTileCells + kLeafSlack>;

// Writes the shape and the leaves of a tile. Returns how many leaves there are; 1 if all cells are
// alike. A checkerboard takes the longest.
std::uint32_t shape_tile(TileCells cells, TileShape& shape, TileLeaves leaves);

}  // namespace iog::tree
