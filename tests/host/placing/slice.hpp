// The index grid of a slice for tests, and headings as rotations.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "geometry/grid.hpp"
#include "placing/placement.hpp"
#include "placing/slice_byte.hpp"

namespace iog::tests {

class Slice {
 public:
  // Of a height nothing is said.
  void set(geometry::Cell cell, int index) {
    tiles_[geometry::tile_of(cell)][in_tile(cell)] = static_cast<std::int8_t>(index);
    low_and_tall_[geometry::tile_of(cell)][row_of(cell)] &= ~bit_of(cell);
  }
  [[nodiscard]] int at(geometry::Cell cell) const {
    const auto tile = tiles_.find(geometry::tile_of(cell));
    return tile == tiles_.end() ? 0 : int{tile->second[in_tile(cell)]};
  }

  // A beam that freed the cell was low; its hit is tall.
  void set_low(geometry::Cell cell) {
    low_and_tall_[geometry::tile_of(cell)][row_of(cell)] |= bit_of(cell);
  }
  void set_tall(geometry::Cell cell) { set_low(cell); }
  // The byte by which the window knows the cell.
  [[nodiscard]] std::int8_t byte_at(geometry::Cell cell) const {
    return placing::byte_of(at(cell), has_bit(cell));
  }

  // All cells that are not 0: visit(cell, index).
  template <typename Visit>
  void for_each(Visit&& visit) const {
    constexpr std::int32_t kSide = geometry::kTileSide;
    constexpr std::int32_t kTiles = geometry::kTilesPerSide;
    for (const auto& [number, cells] : tiles_) {
      const auto tile = static_cast<std::int32_t>(number);
      for (std::int32_t i = 0; i < kSide * kSide; ++i) {
        const geometry::Cell cell{tile % kTiles * kSide + i % kSide,
                                  tile / kTiles * kSide + i / kSide};
        if (const int index{cells[static_cast<std::size_t>(i)]}; index != 0) {
          visit(cell, index);
        }
      }
    }
  }

  // Draws a picture, its lower left cell at `at`: '.' free, ',' free from below, '#' hit, 'o' two
  // hits, 'T' a tall hit; ' ' is left as it is. The first line is the uppermost row.
  Slice& draw(geometry::Cell at, const std::vector<std::string>& picture) {
    for (std::size_t row = 0; row < picture.size(); ++row) {
      const std::string& line = picture[picture.size() - 1 - row];
      for (std::size_t column = 0; column < line.size(); ++column) {
        const char what = line[column];
        const int index = what == '#' || what == 'T' ? 2 : what == 'o' ? 4 : -14;
        const geometry::Cell cell{at.x + static_cast<std::int32_t>(column),
                                  at.y + static_cast<std::int32_t>(row)};
        if (what != ' ') {
          set(cell, index);
        }
        if (what == ',') {
          set_low(cell);
        }
        if (what == 'T') {
          set_tall(cell);
        }
      }
    }
    return *this;
  }

  // visit(tile, indexes, low_and_tall) for each tile in which a cell is not 0.
  template <typename Visit>
  void release(Visit&& visit) const {
    for (const auto& [tile, indexes] : tiles_) {
      if (std::ranges::any_of(indexes, [](std::int8_t index) { return index != 0; })) {
        visit(tile, std::span<const std::int8_t, geometry::kTileCells>(indexes),
              low_and_tall_of(tile));
      }
    }
  }

 private:
  static std::size_t row_of(geometry::Cell cell) {
    return static_cast<std::uint32_t>(cell.y) % geometry::kTileSide;
  }
  static std::uint32_t bit_of(geometry::Cell cell) {
    return std::uint32_t{1} << static_cast<std::uint32_t>(cell.x) % geometry::kTileSide;
  }
  [[nodiscard]] bool has_bit(geometry::Cell cell) const {
    return (low_and_tall_of(geometry::tile_of(cell))[row_of(cell)] & bit_of(cell)) != 0;
  }
  [[nodiscard]] window::Plane low_and_tall_of(std::size_t tile) const {
    const auto bits = low_and_tall_.find(tile);
    return bits == low_and_tall_.end() ? window::Plane{} : bits->second;
  }
  static std::size_t in_tile(geometry::Cell cell) {
    constexpr std::uint32_t kSide = geometry::kTileSide;
    const std::uint32_t x = static_cast<std::uint32_t>(cell.x) % kSide;
    const std::uint32_t y = static_cast<std::uint32_t>(cell.y) % kSide;
    return std::size_t{y} * kSide + x;
  }

  std::map<std::size_t, std::array<std::int8_t, geometry::kTileCells>> tiles_;
  std::map<std::size_t, window::Plane> low_and_tall_;
};

// Gives a slice to whoever takes it tile by tile.
template <typename Taker>
void hand_over(const Slice& slice, Taker& taker) {
  slice.release([&taker](std::size_t tile, auto indexes, const window::Plane& low_and_tall) {
    taker.set(tile, indexes, low_and_tall);
  });
}

inline numeric::Rotation rotation_of(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  constexpr double kOne = 1 << 30;
  return {static_cast<std::int32_t>(std::round(std::cos(angle) * kOne)),
          static_cast<std::int32_t>(std::round(std::sin(angle) * kOne))};
}

inline placing::Placement placed(std::int32_t x_mm, std::int32_t y_mm, double degrees = 0) {
  return {.pose = {.x_mm = x_mm, .y_mm = y_mm}, .rotation = rotation_of(degrees)};
}

}  // namespace iog::tests
