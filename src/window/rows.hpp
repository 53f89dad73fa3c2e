// Rows of bits with what lies around them: a tile's plane between parts of its eight neighbours,
// and what is asked of neighbourhoods, 32 cells at once.
//
// A word is a row: bit 16 is the tile's cell 0, and 16 cells of the neighbours lie on either side.
// Eight rows lie below and eight above. A square of radius r spoils r cells and rows at the border,
// so what is in the middle is right while radii sum up to at most 8.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "window/tile.hpp"

namespace iog::window {

inline constexpr std::size_t kRowMargin = 8;
inline constexpr int kColumnMargin = 16;
inline constexpr std::size_t kRowCount = geometry::kTileSide + 2 * kRowMargin;

// A plane and those around it: row by row from below, the tile's own is the fifth. Never null.
using NinePlanes = std::array<const Plane*, 9>;

struct alignas(16) Rows {
  std::array<std::uint64_t, kRowCount> words{};
};

// The rows of a tile and of kMargin rows around it, kMargin <= kRowMargin.
template <std::size_t kMargin>
inline Rows gather(const NinePlanes& nine) {
  constexpr std::size_t kSide = geometry::kTileSide;
  static_assert(kMargin <= kRowMargin);
  const auto row = [](const NinePlanes& planes, std::size_t first, std::size_t y) {
    return std::uint64_t{(*planes[first])[y] >> (kTileSide - kColumnMargin)} |
           std::uint64_t{(*planes[first + 1])[y]} << kColumnMargin |
           std::uint64_t{(*planes[first + 2])[y]} << (kColumnMargin + kTileSide);
  };
  Rows rows;
  for (std::size_t y = 0; y < kMargin; ++y) {
    rows.words[kRowMargin - kMargin + y] = row(nine, 0, kSide - kMargin + y);
    rows.words[kRowMargin + kSide + y] = row(nine, 6, y);
  }
  for (std::size_t y = 0; y < kSide; ++y) {
    rows.words[kRowMargin + y] = row(nine, 3, y);
  }
  return rows;
}

// The tile's own rows.
inline Plane middle_of(const Rows& rows) {
  Plane plane;
  for (std::size_t y = 0; y < plane.size(); ++y) {
    plane[y] = static_cast<std::uint32_t>(rows.words[kRowMargin + y] >> kColumnMargin);
  }
  return plane;
}

struct Or {
  static constexpr std::uint64_t of(std::uint64_t a, std::uint64_t b) { return a | b; }
};
struct And {
  static constexpr std::uint64_t of(std::uint64_t a, std::uint64_t b) { return a & b; }
};

// Joins each cell with those of the square of 2 kRadius + 1 cells around it, kRadius 1 ... 3. Runs
// of two and of four cells are joined first, so that seven need three steps.
template <typename Join, int kRadius>
inline Rows over_squares(const Rows& in) {
  static_assert(kRadius >= 1 && kRadius <= 3);
  constexpr int kSide = 2 * kRadius + 1;
  constexpr std::size_t kDown = kRadius;
  Rows across;
  for (std::size_t y = 0; y < kRowCount; ++y) {
    const std::uint64_t one = in.words[y];
    const std::uint64_t two = Join::of(one, one >> 1);
    const std::uint64_t most = kRadius == 1 ? two : Join::of(two, two >> 2);
    constexpr int kMost = kRadius == 1 ? 2 : 4;
    across.words[y] = Join::of(most, most >> (kSide - kMost)) << kRadius;
  }
  Rows out;
  for (std::size_t y = kDown; y < kRowCount - kDown; ++y) {
    std::uint64_t word = across.words[y];
    for (std::size_t i = 1; i <= kDown; ++i) {
      word = Join::of(word, Join::of(across.words[y - i], across.words[y + i]));
    }
    out.words[y] = word;
  }
  return out;
}

// Set if a cell of the square is, and if all are.
template <int kRadius>
inline Rows dilated(const Rows& in) {
  return over_squares<Or, kRadius>(in);
}
template <int kRadius>
inline Rows eroded(const Rows& in) {
  return over_squares<And, kRadius>(in);
}

}  // namespace iog::window
