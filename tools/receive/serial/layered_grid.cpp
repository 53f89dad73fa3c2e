#include "tools/receive/serial/layered_grid.hpp"

#include "geometry/grid.hpp"

namespace iog::tools {
namespace {

constexpr std::size_t kTileSide = geometry::kTileSide;

std::size_t tiles_per_side(unsigned level) { return geometry::kTilesPerSide >> level; }

}  // namespace

LayeredGrid::Layer& LayeredGrid::layer(unsigned level) {
  Layer& layer = layers_[level];
  layer.resize(tiles_per_side(level) * tiles_per_side(level));
  return layer;
}

void LayeredGrid::take(unsigned level, const geometry::Grid& grid, std::size_t first,
                       std::span<const std::optional<ToldTile>> tiles,
                       const stream::Header& header) {
  if (grid != grid_) {
    forget();
    grid_ = grid;
  }
  newest_ = header;
  if (!header.has_evidence()) {
    return;
  }
  newest_seen_ = header;
  Layer& to = layer(level);
  for (std::size_t i = 0; i < tiles.size(); ++i) {
    if (tiles[i]) {
      to.at(first + i) = tiles[i];
    }
  }
}

void LayeredGrid::forget() {
  layers_.clear();
  newest_.reset();
  newest_seen_.reset();
}

std::optional<ToldTile> LayeredGrid::cells_of(std::size_t tile) const {
  const auto cells = layers_.find(0);
  return cells == layers_.end() ? std::nullopt : cells->second.at(tile);
}

GridFrame LayeredGrid::composed(std::uint64_t max_age_us) const {
  GridFrame frame;
  if (!newest_seen_) {
    return frame;
  }
  frame.header = *newest_seen_;
  frame.shape = grid_;
  frame.evidence_number = newest_seen_->frame_number;
  // From the roughest to the finest, each over what is there.
  for (auto layer = layers_.rbegin(); layer != layers_.rend(); ++layer) {
    const unsigned level = layer->first;
    const std::size_t side = kTileSide << level;  // of a tile of this level, in cells of the grid
    for (std::size_t tile = 0; tile < layer->second.size(); ++tile) {
      const std::optional<ToldTile>& told = layer->second[tile];
      if (!told || newest_seen_->closed_us - told->closed_us > max_age_us) {
        continue;
      }
      const std::size_t corner_x = tile % tiles_per_side(level) * side;
      const std::size_t corner_y = tile / tiles_per_side(level) * side;
      for (std::size_t i = 0; i < side * side; ++i) {
        const std::size_t x = i % side;
        const std::size_t y = i / side;
        const std::size_t place = (y >> level) * kTileSide + (x >> level);
        frame.cells[(corner_y + y) * geometry::kCellsPerSide + corner_x + x] =
            told->cells ? static_cast<index::OccupancyIndex>((*told->cells)[place])
                        : index::kUnknown;
      }
    }
  }
  return frame;
}

}  // namespace iog::tools
