// Blocks of cells: what the nodes of a 2^d-tree stand for (thesis section 3.5.2).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "index/occupancy_index.hpp"

namespace iog::tree {

// Coordinates in cells from the grid's lowest corner, x first.
template <std::size_t kDimension>
using Cell = std::array<std::uint32_t, kDimension>;

// The block with this lowest cell: 2^side_log2 cells along each dimension.
template <std::size_t kDimension>
struct Block {
  Cell<kDimension> corner{};
  std::uint32_t side_log2 = 0;

  friend bool operator==(const Block&, const Block&) = default;
};

// A block of cells that all have this index, and that is not part of a larger one.
template <std::size_t kDimension>
struct Leaf {
  Block<kDimension> block;
  index::OccupancyIndex index = index::kUnknown;

  friend bool operator==(const Leaf&, const Leaf&) = default;
};

// Moves the 16 low bits of a number to the even places of a word, and back: first the halves move
// apart, then the quarters, and so on.
[[nodiscard]] constexpr std::uint32_t spread_bits(std::uint32_t bits) {
  bits = (bits | bits << 8) & 0x00FF00FFU;
  bits = (bits | bits << 4) & 0x0F0F0F0FU;
  bits = (bits | bits << 2) & 0x33333333U;
  return (bits | bits << 1) & 0x55555555U;
}

[[nodiscard]] constexpr std::uint32_t gather_bits(std::uint32_t bits) {
  bits &= 0x55555555U;
  bits = (bits | bits >> 1) & 0x33333333U;
  bits = (bits | bits >> 2) & 0x0F0F0F0FU;
  bits = (bits | bits >> 4) & 0x00FF00FFU;
  return (bits | bits >> 8) & 0x0000FFFFU;
}

// The place of a cell in Morton order: the bits of its coordinates interleaved, those of x lowest.
// In this order the cells of a block follow one another, and so do those of each of its 2^d parts.
// Coordinates are below 2^bits, and d * bits is at most 32. Two dimensions have a faster way of
// their own, because their trees are built every frame.
template <std::size_t kDimension>
[[nodiscard]] constexpr std::uint32_t morton_place(const Cell<kDimension>& cell,
                                                   std::uint32_t bits) {
  if constexpr (kDimension == 2) {
    return spread_bits(cell[0]) | spread_bits(cell[1]) << 1;
  }
  std::uint32_t place = 0;
  for (std::uint32_t bit = bits; bit-- > 0;) {
    for (std::size_t axis = kDimension; axis-- > 0;) {
      place = place << 1 | (cell[axis] >> bit & 1U);
    }
  }
  return place;
}

// The cell at a place of the Morton order.
template <std::size_t kDimension>
[[nodiscard]] constexpr Cell<kDimension> morton_cell(std::uint32_t place) {
  Cell<kDimension> cell{};
  if constexpr (kDimension == 2) {
    return {gather_bits(place), gather_bits(place >> 1)};
  }
  for (std::uint32_t bit = 0; place != 0; ++bit) {
    for (std::size_t axis = 0; axis < kDimension; ++axis) {
      cell[axis] |= (place & 1U) << bit;
      place >>= 1;
    }
  }
  return cell;
}

}  // namespace iog::tree
