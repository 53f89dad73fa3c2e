// The linear quadtree of a grid: the leaves of the tree of thesis section 3.5, without its nodes.
//
// lab/tree/quadtree_builder.hpp builds it anew from the fused array every frame; here it is only
// read. Each of the 32 by 32 tiles has an entry. If all cells of a tile are alike, the entry holds
// their index; four such tiles that are alike are one leaf, and so on up to the whole grid. Every
// other tile has a shape of 52 bytes and its leaves, a byte each (lab/tree/tile_shape.hpp).
//
// Memory. The entries take 4 KiB. A tile that is not uniform takes 52 bytes, and a byte a leaf. The
// array has a byte a cell. So where a leaf stands for 3.75 cells (thesis table 4.7) the tree has
// less than a third of the array's bytes; the thesis's tree had 3.15 times as many. The owner gives
// the memory of the leaves, as much as it can spare: kWorstLeafBytes are enough for any grid.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "index/occupancy_index.hpp"
#include "lab/tree/block.hpp"
#include "lab/tree/quarter_leaves.hpp"
#include "lab/tree/tile_shape.hpp"

namespace iog::tree {

inline constexpr std::uint32_t kGridSideLog2 =
    std::bit_width(std::uint32_t{geometry::kCellsPerSide}) - 1;
static_assert(std::uint32_t{1} << kGridSideLog2 == geometry::kCellsPerSide);
inline constexpr std::uint32_t kGridSide = std::uint32_t{1} << kGridSideLog2;
inline constexpr std::uint32_t kTilesPerSide = kGridSide >> kTileSideLog2;
inline constexpr std::size_t kTiles = std::size_t{kTilesPerSide} * kTilesPerSide;

inline constexpr std::size_t kLeastLeafBytes = kTileCells + kLeafSlack;
inline constexpr std::size_t kWorstLeafBytes = kTiles * kTileCells + kLeafSlack;

// Cells x ... x + width - 1 and y ... y + height - 1; may reach out of the grid.
struct Rectangle {
  std::int32_t x = 0;
  std::int32_t y = 0;
  std::int32_t width = 0;  // below 1: no cell at all
  std::int32_t height = 0;
};

class LinearQuadtree {
 public:
  using Cell = tree::Cell<2>;
  using Leaf = tree::Leaf<2>;

  // An unknown grid. leaf_memory outlives the tree and has at least kLeastLeafBytes.
  explicit LinearQuadtree(std::span<std::byte> leaf_memory);

  // The leaf that holds a cell of the grid: the largest uniform block around it.
  [[nodiscard]] Leaf leaf_at(const Cell& cell) const;

  // Whether every cell of the rectangle is likely free: its index is below 0. Cells outside of the
  // grid are unknown, so not free. Looks at the leaves of the quarter tiles that it meets, up to
  // the first that is not free.
  [[nodiscard]] bool is_free(const Rectangle& rectangle) const;

  // Calls visit(Leaf) for every leaf, in Morton order.
  template <typename Visit>
  void for_each_leaf(Visit&& visit) const;

  // As table 4.7 counts them: every split makes four nodes, and three leaves more than there were.
  [[nodiscard]] std::size_t leaves() const { return leaf_count_; }
  [[nodiscard]] std::size_t nodes() const { return leaf_count_ + (leaf_count_ - 1) / 3; }

  // What this grid's tree needs: entries, shapes and leaves.
  [[nodiscard]] std::size_t used_bytes() const {
    return sizeof(entries_) + record_count_ * sizeof(TileRecord) + leaf_bytes_;
  }

  // Tiles whose leaves found no room. They read as unknown. If there are none, the tree is equal to
  // the array, cell for cell.
  [[nodiscard]] std::size_t lost_tiles() const { return lost_tiles_; }

 private:
  friend class QuadtreeBuilder;

  // One tile. side_log2 is meant if all its cells are alike: the side of the leaf that begins in
  // its lowest corner. Tiles that lie elsewhere in that leaf keep the side that they had before it
  // grew.
  struct Entry {
    std::uint16_t record = kNoRecord;
    std::uint8_t side_log2 = kTileSideLog2;
    index::OccupancyIndex index = index::kUnknown;

    friend bool operator==(const Entry&, const Entry&) = default;
  };
  static constexpr std::uint16_t kNoRecord = 0xFFFF;
  static_assert(kTiles <= kNoRecord && sizeof(Entry) == 4);

  // A tile that is split.
  struct TileRecord {
    TileShape shape;
    std::uint32_t first_leaf = 0;
  };
  static_assert(sizeof(TileRecord) == 52);

  // A rectangle inside the grid: its lowest and its highest cell.
  struct Area {
    Cell low;
    Cell high;

    [[nodiscard]] bool meets(const Block<2>& block) const {
      const std::uint32_t reach = (1U << block.side_log2) - 1;
      return block.corner[0] <= high[0] && low[0] <= block.corner[0] + reach &&
             block.corner[1] <= high[1] && low[1] <= block.corner[1] + reach;
    }
  };

  // The leaves of a quarter of a split tile.
  [[nodiscard]] std::span<const std::byte> leaves_of(const TileRecord& record,
                                                     std::size_t quarter) const;

  // corner: of the tile, which the area meets.
  [[nodiscard]] bool is_free_in_tile(const Cell& corner, const Area& area) const;

  std::array<Entry, kTiles> entries_{};  // in Morton order
  std::size_t record_count_ = 0;
  std::size_t leaf_bytes_ = 0;
  std::size_t leaf_count_ = 1;
  std::size_t lost_tiles_ = 0;
  std::span<std::byte> leaf_memory_;
  std::array<TileRecord, kTiles> records_{};
};

template <typename Visit>
void LinearQuadtree::for_each_leaf(Visit&& visit) const {
  for (std::uint32_t tile = 0; tile < kTiles;) {
    const Entry& entry = entries_[tile];
    const Cell corner = morton_cell<2>(tile * kTileCells);
    if (entry.record == kNoRecord) {
      visit(Leaf{{corner, entry.side_log2}, entry.index});
      tile += 1U << (2 * (entry.side_log2 - kTileSideLog2));
      continue;
    }
    for (std::size_t quarter = 0; quarter < 4; ++quarter) {
      const TileRecord& record = records_[entry.record];
      QuarterLeaves leaves(record.shape[quarter], leaves_of(record, quarter));
      for (; !leaves.at_end(); leaves.next()) {
        visit(Leaf{leaves.block(quarter_corner(corner, quarter)), leaves.index()});
      }
    }
    ++tile;
  }
}

}  // namespace iog::tree
