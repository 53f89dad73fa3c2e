// Stores a tile and the adjacent cells of its eight neighbours as rows of bits. Neighbourhood
// operations process 32 cells at once. Each word represents a row.
//
// Bit 16 represents cell 0 of the tile. Each row also contains 16 cells from the neighbour on
// either side. There are eight additional rows below the tile and eight above it. An operation on
// squares of radius r invalidates the outermost r cells of each row and the outermost r rows. The
// tile's own bits are therefore correct as long as the sum of the radii is at most 8.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lanes/lanes.hpp"
#include "window/tile.hpp"

namespace iog::window {

using lanes::RowPair;

inline constexpr std::size_t kRowMargin = 8;
inline constexpr int kColumnMargin = 16;
inline constexpr std::size_t kRowCount = geometry::kTileSide + 2 * kRowMargin;

// The planes of a tile and its neighbours, row by row from the lowest row. The plane of the tile
// itself is in the middle, at index 4. The pointers are never null.
using NinePlanes = std::array<const Plane*, 9>;

struct alignas(16) Rows {
  std::array<std::uint64_t, kRowCount> words;  // written completely by each producer
};

// Returns the rows of a tile and of kMargin rows below and above it. Requires kMargin <=
// kRowMargin. All other rows are zero.
template <std::size_t kMargin>
inline Rows gather(const NinePlanes& nine) {
  constexpr std::size_t kSide = geometry::kTileSide;
  static_assert(kMargin <= kRowMargin);
  const auto row = [&nine](std::size_t first, std::size_t y) {
    return std::uint64_t{(*nine[first])[y] >> (kTileSide - kColumnMargin)} |
           std::uint64_t{(*nine[first + 1])[y]} << kColumnMargin |
           std::uint64_t{(*nine[first + 2])[y]} << (kColumnMargin + kTileSide);
  };
  Rows rows;
  for (std::size_t y = 0; y < kRowMargin; ++y) {
    rows.words[y] = y < kRowMargin - kMargin ? 0 : row(0, kSide - kRowMargin + y);
    rows.words[kRowMargin + kSide + y] = y < kMargin ? row(6, y) : 0;
  }
  for (std::size_t y = 0; y < kSide; ++y) {
    rows.words[kRowMargin + y] = row(3, y);
  }
  return rows;
}

// Returns only the rows of the tile itself.
inline Plane middle_of(const Rows& rows) {
  static_assert(kColumnMargin == 16, "what RowPair takes for the middle");
  Plane plane;
  for (std::size_t y = 0; y < plane.size(); y += 2) {
    RowPair::load(&rows.words[kRowMargin + y]).store_middle(&plane[y]);
  }
  return plane;
}

struct Or {
  static RowPair of(RowPair a, RowPair b) { return a.bit_or(b); }
};
struct And {
  static RowPair of(RowPair a, RowPair b) { return a.bit_and(b); }
};
struct AndNot {
  static RowPair of(RowPair a, RowPair b) { return a.and_not(b); }
};

template <typename Join>
inline Rows joined(const Rows& a, const Rows& b) {
  Rows out;
  for (std::size_t y = 0; y < kRowCount; y += 2) {
    Join::of(RowPair::load(&a.words[y]), RowPair::load(&b.words[y])).store(&out.words[y]);
  }
  return out;
}

// Combines each cell of a row with the kRadius cells to its left and the kRadius cells to its
// right. Cells are first combined in runs of two and then in runs of four, so that seven cells need
// only three steps.
template <typename Join, int kRadius>
inline RowPair over_runs(RowPair one) {
  constexpr int kSide = 2 * kRadius + 1;
  constexpr int kMost = kRadius == 1 ? 2 : 4;
  const RowPair two = Join::of(one, one.template down<1>());
  const RowPair most = kMost == 2 ? two : Join::of(two, two.template down<2>());
  return Join::of(most, most.template down<kSide - kMost>()).template up<kRadius>();
}

// Combines each cell with all cells of the surrounding square, whose side length is 2 * kRadius +
// 1. `kRadius` must be 1, 2 or 3. The outermost kRadius rows are set to zero.
template <typename Join, int kRadius>
inline Rows over_squares(const Rows& in) {
  static_assert(kRadius >= 1 && kRadius <= 3);
  constexpr std::size_t kAway = kRadius;
  Rows across;
  for (std::size_t y = 0; y < kRowCount; y += 2) {
    over_runs<Join, kRadius>(RowPair::load(&in.words[y])).store(&across.words[y]);
  }
  Rows out;
  for (std::size_t y = 0; y < kAway; ++y) {
    out.words[y] = 0;
    out.words[kRowCount - 1 - y] = 0;
  }
  for (std::size_t y = kAway; y < kRowCount - kAway; y += 2) {
    RowPair rows = RowPair::load(&across.words[y - kAway]);
    for (std::size_t i = 1; i <= 2 * kAway; ++i) {
      rows = Join::of(rows, RowPair::load(&across.words[y - kAway + i]));
    }
    rows.store(&out.words[y]);
  }
  return out;
}

// `dilated()` sets a cell if any cell of the square is set. `eroded()` sets a cell if all cells of
// the square are set.
template <int kRadius>
inline Rows dilated(const Rows& in) {
  return over_squares<Or, kRadius>(in);
}
template <int kRadius>
inline Rows eroded(const Rows& in) {
  return over_squares<And, kRadius>(in);
}

// The following overloads take a radius from 1 to 3 as an argument because the radius depends on
// the cell size.
inline Rows dilated(const Rows& in, int radius) {
  return radius == 1 ? dilated<1>(in) : radius == 2 ? dilated<2>(in) : dilated<3>(in);
}
inline Rows eroded(const Rows& in, int radius) {
  return radius == 1 ? eroded<1>(in) : radius == 2 ? eroded<2>(in) : eroded<3>(in);
}

}  // namespace iog::window
