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

std::uint32_t class_crc_of(const ClassGrid& classes) {
  stream::ClassHash hash({.a = classes.window.corner_a, .b = classes.window.corner_b});
  for (std::size_t slot = 0; slot < geometry::kTileCount; ++slot) {
    if (const std::optional<TileBytes> cells = classes_of_tile(classes, slot)) {
      hash.add(slot, *cells);
    }
  }
  return hash.value();
}

}  // namespace iog::tools
