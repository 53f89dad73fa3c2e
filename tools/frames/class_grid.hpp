// The classes of a frame as a receiver has put them together from its messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/grid.hpp"
#include "stream/class_end.hpp"
#include "stream/class_window.hpp"
#include "tools/frames/tile_set.hpp"

namespace iog::tools {

// By tile of a window's messages, its slot; kTileCount: no tile.
using SlotsOfTiles = std::array<std::size_t, geometry::kTileCount>;

struct ClassGrid {
  stream::ClassWindow window;  // where it is; of any of its messages
  std::uint16_t cell_mm = geometry::kCellMm;
  window::Extent extent{};
  stream::ClassEnd end;  // only if has_end
  bool has_end = false;
  // Everything has arrived, but it is not the grid that the target has hashed. No tile is valid.
  bool is_damaged = false;
  // Sets of tiles are by slot (window::slot_of). Tiles outside the window are valid and unknown.
  TileSet valid_tiles;  // whose cells are those of this frame; all others are missing
  TileSet known_tiles;  // of these, those that the target knows something of
  // By slot, of known tiles: frames since it was decided, 255: 255 or more.
  std::array<std::uint8_t, geometry::kTileCount> age_frames{};
  // Class bytes (stream::class_of, stream::sureness_of) row by row from the window's corner, 1024 a
  // row; of a missing tile, and outside the window, 0.
  std::vector<std::int8_t> cells = std::vector<std::int8_t>(geometry::kCellCount);

  // Whether anything has arrived, so that the window is known.
  [[nodiscard]] bool has_window() const { return has_end || valid_tiles.any(); }
  // Takes the size of its cells and its sides from those of its messages.
  SlotsOfTiles take_shape(const geometry::Grid& shape);
  // Takes sets of tiles that are by tile of its messages.
  void take_tiles(const SlotsOfTiles& slots, const TileSet& valid, const TileSet& known);

  [[nodiscard]] window::Area area() const { return stream::area_of(window, extent); }
  // Everything that the target knows has arrived.
  [[nodiscard]] bool is_whole() const {
    return has_end && end.tiles_lost == 0 && valid_tiles.all() &&
           known_tiles.count() == end.tiles_sent;
  }
};

// Where the tile at a slot is in the window, row by row from its corner.
[[nodiscard]] constexpr std::size_t tile_in_window(const stream::ClassWindow& window,
                                                   std::size_t slot) {
  const window::TileNumber tile = stream::area_of(window).tile_at(slot);
  const auto across = [](std::int32_t place, std::int32_t corner) {
    return static_cast<std::size_t>(static_cast<std::uint32_t>(place) -
                                    static_cast<std::uint32_t>(corner));
  };
  return across(tile.b, window.corner_b) * geometry::kTilesPerSide +
         across(tile.a, window.corner_a);
}

// The name of the class grid as it has arrived (docs/spec.md 3.10). The name that the target gave
// it is end.classes_crc.
[[nodiscard]] std::uint32_t class_crc_of(const ClassGrid& classes);

}  // namespace iog::tools
