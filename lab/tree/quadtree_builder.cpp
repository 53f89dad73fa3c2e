#include "lab/tree/quadtree_builder.hpp"

#include "require/require.hpp"

namespace iog::tree {

void QuadtreeBuilder::begin() {
  tree_->entries_.fill({});
  tree_->record_count_ = 0;
  tree_->leaf_bytes_ = 0;
  tree_->leaf_count_ = kTiles;
  tree_->lost_tiles_ = 0;
}

// The shape is written where it would stay, and stays if the tile is not uniform.
TileFate QuadtreeBuilder::add(std::size_t tile_x, std::size_t tile_y, TileCells cells) {
  LinearQuadtree& tree = *tree_;
  require(tile_x < kTilesPerSide && tile_y < kTilesPerSide);
  const Cell<2> tile{static_cast<std::uint32_t>(tile_x), static_cast<std::uint32_t>(tile_y)};
  LinearQuadtree::Entry& entry = tree.entries_[morton_place(tile, kGridSideLog2 - kTileSideLog2)];
  require(entry == LinearQuadtree::Entry{});
  const std::span<std::byte> room = tree.leaf_memory_.subspan(tree.leaf_bytes_);
  if (room.size() < kLeastLeafBytes) {
    ++tree.lost_tiles_;
    return TileFate::kNoRoom;
  }
  LinearQuadtree::TileRecord& record = tree.records_[tree.record_count_];
  const std::uint32_t leaves = shape_tile(cells, record.shape, room.first<kLeastLeafBytes>());
  if (leaves == 1) {
    entry.index = static_cast<index::OccupancyIndex>(room[0]);
    return TileFate::kAdded;
  }
  record.first_leaf = static_cast<std::uint32_t>(tree.leaf_bytes_);
  entry = {.record = static_cast<std::uint16_t>(tree.record_count_), .side_log2 = 0};
  ++tree.record_count_;
  tree.leaf_bytes_ += leaves;
  tree.leaf_count_ += leaves - 1;
  return TileFate::kAdded;
}

// The lowest tile of a uniform block says its side. Four blocks whose sides are one less than that
// of the block around them, and whose indexes are one, are that block.
void QuadtreeBuilder::finish() {
  auto& entries = tree_->entries_;
  std::size_t part = 1;
  for (std::uint32_t side_log2 = kTileSideLog2; side_log2 < kGridSideLog2; ++side_log2) {
    for (std::size_t first = 0; first < kTiles; first += 4 * part) {
      LinearQuadtree::Entry& lowest = entries[first];
      if (lowest.side_log2 == side_log2 && entries[first + part] == lowest &&
          entries[first + 2 * part] == lowest && entries[first + 3 * part] == lowest) {
        ++lowest.side_log2;
        tree_->leaf_count_ -= 3;
      }
    }
    part *= 4;
  }
}

}  // namespace iog::tree
