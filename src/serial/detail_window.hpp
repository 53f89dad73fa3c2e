// Stores copies of a few known tiles of a frame, starting at a given tile number. The window stores
// as many tiles as the serial link can transmit before the next frame. A new frame therefore needs
// only a few copies, even if it has many tiles.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "tile_coding/tile_cells.hpp"

namespace iog::serial {

class DetailWindow {
 public:
  // At 115200 baud, the link transmits 460 bytes per frame, and a known tile takes more than 14
  // bytes.
  static constexpr std::size_t kTiles = 32;

  // Empties the window. Until the next call, tiles below `first_tile` are ignored.
  void begin(std::size_t first_tile) {
    first_ = first_tile;
    end_ = geometry::kTileCount;
    count_ = 0;
  }

  // Adds the frame's known tiles in ascending order.
  void add_tile(std::size_t tile, tile_coding::TileCells cells) {
    if (tile < first_ || tile >= end_) {
      return;
    }
    if (count_ == kTiles) {
      end_ = tile;
      return;
    }
    numbers_[count_] = static_cast<std::uint16_t>(tile);
    std::ranges::copy(cells, cells_[count_].begin());
    ++count_;
  }

  // Returns the (exclusive) end of the range of tiles that the window covers. If find() does not
  // find a tile in this range, the tile is unknown.
  [[nodiscard]] std::size_t end() const { return end_; }

  // Returns the position of the first known tile whose number is at least `tile`. If there is none,
  // returns count().
  [[nodiscard]] std::size_t find(std::size_t tile) const {
    const auto numbers = std::span(numbers_).first(count_);
    return static_cast<std::size_t>(std::ranges::lower_bound(numbers, tile) - numbers.begin());
  }
  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] std::size_t number(std::size_t place) const { return numbers_[place]; }
  [[nodiscard]] tile_coding::TileCells cells(std::size_t place) const { return cells_[place]; }

 private:
  std::size_t first_ = 0;
  std::size_t end_ = 0;
  std::size_t count_ = 0;
  std::array<std::uint16_t, kTiles> numbers_{};
  alignas(8) std::array<std::array<std::byte, tile_coding::kTileBytes>, kTiles> cells_{};
};

}  // namespace iog::serial
