// What a receiver on the serial link knows of the grid: of each tile the newest cells that have
// come, and beneath them the coarse grids (docs/spec.md 3.8), each with the frame that it is of.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "stream/tiles.hpp"
#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

// A tile of one level's grid; without cells all of them are unknown.
struct ToldTile {
  std::uint32_t frame_number = 0;
  std::uint64_t closed_us = 0;  // that frame, by the target's clock
  std::optional<std::array<std::byte, tile_coding::kTileBytes>> cells{};
};

class LayeredGrid {
 public:
  // Takes the tiles of a message from tile `first` on, except for tiles that could not be read.
  // `level` is 0 for cells, otherwise a level of the quadtree (stream::geometry_of_level). If the
  // grid differs from the previous one, everything earlier is discarded.
  void take(unsigned level, const geometry::Grid& grid, std::size_t first,
            std::span<const std::optional<ToldTile>> tiles, const stream::Header& header);

  // The target runs anew: nothing that is known is of now.
  void forget();

  // The header of the newest frame that was told of, and of the newest in which a sensor took part:
  // others say nothing of any cell.
  [[nodiscard]] const std::optional<stream::Header>& newest() const { return newest_; }
  [[nodiscard]] const std::optional<stream::Header>& newest_seen() const { return newest_seen_; }

  // A tile of cells; nothing if it was never told of.
  [[nodiscard]] std::optional<ToldTile> cells_of(std::size_t tile) const;

  // How much older than the newest frame it is.
  [[nodiscard]] std::uint64_t age_us(const ToldTile& tile) const {
    return newest_->closed_us - tile.closed_us;
  }

  // The grid when a sensor last took part, as far as it had been told of not longer ago than that:
  // cells where they are, else the finest coarse grid, else unknown. For those who draw frames.
  [[nodiscard]] GridFrame composed(std::uint64_t max_age_us) const;

 private:
  using Layer = std::vector<std::optional<ToldTile>>;

  [[nodiscard]] Layer& layer(unsigned level);

  std::map<unsigned, Layer> layers_;  // by level, the finest first
  geometry::Grid grid_;
  std::optional<stream::Header> newest_;
  std::optional<stream::Header> newest_seen_;
};

}  // namespace iog::tools
