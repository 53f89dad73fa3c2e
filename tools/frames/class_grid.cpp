#include "tools/frames/class_grid.hpp"

#include <optional>

#include "stream/class_hash.hpp"
#include "tools/frames/grid_frame.hpp"
#include "tools/frames/tile_messages.hpp"

namespace iog::tools {
namespace {

// Nothing if no cell of it has a class.
std::optional<TileBytes> classes_of_tile(const ClassGrid& classes, std::size_t slot) {
  const TileBytes cells = cells_of_tile(classes.cells, tile_in_window(classes.window, slot));
  return cells != TileBytes{} ? std::optional(cells) : std::nullopt;
}

}  // namespace

SlotsOfTiles ClassGrid::take_shape(const geometry::Grid& shape) {
  cell_mm = shape.cell_mm;
  extent = {.columns = static_cast<std::uint8_t>(shape.columns / geometry::kTileSide),
            .rows = static_cast<std::uint8_t>(shape.rows / geometry::kTileSide)};
  SlotsOfTiles slots{};
  slots.fill(geometry::kTileCount);
  area().for_each_tile([&](std::size_t number, window::TileNumber tile) {
    slots.at(number) = window::slot_of(tile);
  });
  return slots;
}

void ClassGrid::take_tiles(const SlotsOfTiles& slots, const TileSet& valid, const TileSet& known) {
  valid_tiles = valid.any() ? TileSet().set() : TileSet();
  for (std::size_t tile = 0; tile < slots.size(); ++tile) {
    if (slots.at(tile) < geometry::kTileCount) {
      valid_tiles.set(slots.at(tile), valid.test(tile));
      known_tiles.set(slots.at(tile), known.test(tile));
    }
  }
}

std::uint32_t class_crc_of(const ClassGrid& classes) {
  stream::ClassHash hash({.a = classes.window.corner_a, .b = classes.window.corner_b});
  classes.area().for_each_tile([&](std::size_t number, window::TileNumber tile) {
    if (const auto cells = classes_of_tile(classes, window::slot_of(tile))) {
      hash.add(number, *cells);
    }
  });
  return hash.value();
}

}  // namespace iog::tools
