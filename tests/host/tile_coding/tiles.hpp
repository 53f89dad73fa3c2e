// Tiles that are easy, likely, or hard on an encoding.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

#include "fakes/random.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::tile_coding {

using Tile = std::array<std::byte, kTileBytes>;

inline Tile flat_tile(int value) {
  Tile tile{};
  tile.fill(static_cast<std::byte>(value));
  return tile;
}

// Rows of one character a cell; rows that are not given are like the last one.
inline Tile tile_of(std::initializer_list<const char*> rows) {
  Tile tile{};
  for (std::size_t y = 0; y < kTileSide; ++y) {
    const char* row = *(rows.begin() + std::min(y, rows.size() - 1));
    for (std::size_t x = 0; x < kTileSide; ++x) {
      tile.at(y * kTileSide + x) =
          row[x] == '.' ? std::byte{0} : static_cast<std::byte>(row[x] - '0');
    }
  }
  return tile;
}

inline Tile checkerboard(int even, int odd) {
  Tile tile{};
  for (std::size_t i = 0; i < tile.size(); ++i) {
    tile[i] = static_cast<std::byte>((i / kTileSide + i) % 2 == 0 ? even : odd);
  }
  return tile;
}

// Each cell one of `values` values from -127 on, whatever its neighbours are.
inline Tile noise(tests::Random& random, int values) {
  Tile tile{};
  for (std::byte& cell : tile) {
    cell = static_cast<std::byte>(random.between(-127, -128 + values));
  }
  return tile;
}

// Flat, with rectangles of few values on it: nearer to a street than noise is.
inline Tile rectangles(tests::Random& random) {
  Tile tile = flat_tile(random.one_in(2) ? 0 : -14);
  for (int count = random.between(0, 20); count > 0; --count) {
    const auto value = static_cast<std::byte>(random.between(-8, 8));
    const std::size_t x = random.below(kTileSide);
    const std::size_t y = random.below(kTileSide);
    const std::size_t width = 1 + random.below(kTileSide - x);
    const std::size_t height = 1 + random.below(kTileSide - y);
    for (std::size_t i = 0; i < width * height; ++i) {
      tile.at((y + i / width) * kTileSide + x + i % width) = value;
    }
  }
  return tile;
}

// Runs of any lengths, of few values.
inline Tile runs(tests::Random& random) {
  Tile tile{};
  const int longest = random.between(1, 90);
  for (std::size_t cell = 0; cell < tile.size();) {
    const auto value = static_cast<std::byte>(random.between(-3, 3));
    for (int left = random.between(1, longest); left > 0 && cell < tile.size(); --left) {
      tile.at(cell++) = value;
    }
  }
  return tile;
}

// Another one, with some cells changed.
inline Tile changed(Tile tile, tests::Random& random) {
  for (int count = random.between(0, 30); count > 0; --count) {
    tile.at(random.below(tile.size())) = static_cast<std::byte>(random.between(-127, 127));
  }
  return tile;
}

}  // namespace iog::tile_coding
