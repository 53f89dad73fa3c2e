// A frame as a receiver has put it together from its messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "fusion/frame_fusion.hpp"
#include "geometry/grid.hpp"
#include "stream/message.hpp"
#include "stream/objects.hpp"
#include "tile_coding/tile_cells.hpp"
#include "tools/frames/class_grid.hpp"
#include "tools/frames/reception_parts.hpp"
#include "tools/frames/tile_set.hpp"

namespace iog::tools {

struct GridFrame {
  // Among the frames with evidence, from 0; meaningless in a frame without.
  std::uint64_t evidence_number = 0;
  stream::Header header;  // of its last message, or of its tiles if that is lost
  stream::FrameEnd end;   // only if has_end
  bool has_end = false;
  std::uint16_t epsilon_e5 = 0;  // of its indexes; 0 before their first message
  // Everything has arrived, but it is not the grid that the target has hashed. No tile is valid.
  bool is_damaged = false;
  geometry::Grid shape;  // of its grid of occupancy indexes
  // Sets of tiles are by tile of the grid. Tiles beyond its last one are valid and unknown.
  TileSet valid_tiles;      // whose cells are those of this frame; all others are missing
  TileSet known_tiles;      // of these, those in which something is known
  std::uint32_t tiles = 0;  // how many these are
  // The grid row by row from the lowest y; a cell of a missing tile is 0, and so is the rest.
  std::vector<index::OccupancyIndex> cells =
      std::vector<index::OccupancyIndex>(geometry::kCellCount, index::kUnknown);
  // If the target sends classes (stream::kFlagClasses).
  std::optional<ClassGrid> classes{};
  // If the target looks for objects (stream::kFlagObjects), and all of their list has come.
  std::optional<stream::ObjectList> objects{};
  // If its classes depend on when packets arrive (stream::kFlagReceptions), and all of it has come.
  std::optional<Receptions> receptions{};

  // Everything that the target knows of the grid has arrived, or it sends none; of its classes see
  // there.
  [[nodiscard]] bool is_whole() const {
    const bool has_tiles = end.tiles_lost == 0 && valid_tiles.all() && tiles == end.tiles_sent;
    return has_end && (has_tiles || !header.has_indexes());
  }
  // The list has come, and the frame has a place.
  [[nodiscard]] bool knows_objects() const { return objects && objects->has_place(); }
  // Epsilon of the recursive set, for the probabilities of indexes.
  [[nodiscard]] std::optional<double> epsilon() const {
    return epsilon_e5 > 0 ? std::optional(epsilon_e5 / 1e5) : std::nullopt;
  }
  [[nodiscard]] std::span<const index::OccupancyIndex, geometry::kCellCount> grid() const {
    return std::span(cells).first<geometry::kCellCount>();
  }
};

// The cells of the grid alone, row by row from the lowest y.
[[nodiscard]] std::vector<index::OccupancyIndex> cells_in_grid(const GridFrame& frame);

// The number in the grid of a tile's cell i. Both count row by row.
[[nodiscard]] constexpr std::size_t cell_of_tile(std::size_t tile, std::size_t i,
                                                 const geometry::Grid& grid = {}) {
  const std::size_t across = grid.tiles_across();
  const std::size_t x = tile % across * geometry::kTileSide + i % geometry::kTileSide;
  const std::size_t y = tile / across * geometry::kTileSide + i / geometry::kTileSide;
  return y * grid.columns + x;
}

// The cells of a tile of this grid, as they travel.
[[nodiscard]] std::array<std::byte, tile_coding::kTileBytes> cells_of_tile(
    std::span<const std::int8_t> cells, std::size_t tile, const geometry::Grid& grid = {});

// Puts them back.
void put_tile(std::span<const std::byte, tile_coding::kTileBytes> tile_cells, std::size_t tile,
              std::span<std::int8_t> cells, const geometry::Grid& grid = {});

// The name of the grid as it has arrived. The name that the target gave it is end.grid_crc.
[[nodiscard]] std::uint32_t grid_crc_of(const GridFrame& frame);

}  // namespace iog::tools
