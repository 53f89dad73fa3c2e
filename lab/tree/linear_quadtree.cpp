#include "lab/tree/linear_quadtree.hpp"

#include "require/require.hpp"

namespace iog::tree {
namespace {

constexpr std::uint32_t kTileMask = kTileSide - 1;

// The lowest of the cells that lie in one block of this side with the cell at a place, as a place.
constexpr std::uint32_t lowest_place(std::uint32_t place, std::uint32_t side_log2) {
  return place >> (2 * side_log2) << (2 * side_log2);
}

}  // namespace

LinearQuadtree::LinearQuadtree(std::span<std::byte> leaf_memory) : leaf_memory_(leaf_memory) {
  require(leaf_memory.size() >= kLeastLeafBytes);
  entries_[0].side_log2 = kGridSideLog2;
}

std::span<const std::byte> LinearQuadtree::leaves_of(const TileRecord& record,
                                                     std::size_t quarter) const {
  std::size_t first = record.first_leaf;
  for (std::size_t before = 0; before < quarter; ++before) {
    first += record.shape[before].leaves();
  }
  return leaf_memory_.subspan(first, record.shape[quarter].leaves());
}

// Of a uniform leaf of several tiles, only the lowest tile's entry says how large it is; so the
// largest block around the cell is tried first.
LinearQuadtree::Leaf LinearQuadtree::leaf_at(const Cell& cell) const {
  require(cell[0] < kGridSide && cell[1] < kGridSide);
  const std::uint32_t place = morton_place(cell, kGridSideLog2);
  const Entry& entry = entries_[place / kTileCells];
  if (entry.record == kNoRecord) {
    std::uint32_t side_log2 = kGridSideLog2;
    while (entries_[lowest_place(place, side_log2) / kTileCells].side_log2 < side_log2) {
      --side_log2;
    }
    return {{morton_cell<2>(lowest_place(place, side_log2)), side_log2}, entry.index};
  }
  const TileRecord& record = records_[entry.record];
  const std::uint32_t quarter = place / kQuarterCells % 4;
  const QuarterLeaf leaf = record.shape[quarter].leaf_at(place % kQuarterCells);
  return {{morton_cell<2>(lowest_place(place, leaf.side_log2)), leaf.side_log2},
          static_cast<index::OccupancyIndex>(leaves_of(record, quarter)[leaf.number])};
}

bool LinearQuadtree::is_free(const Rectangle& rectangle) const {
  if (rectangle.width < 1 || rectangle.height < 1) {
    return true;
  }
  constexpr auto kEnd = static_cast<std::int32_t>(kGridSide);
  if (rectangle.x < 0 || rectangle.x > kEnd - rectangle.width || rectangle.y < 0 ||
      rectangle.y > kEnd - rectangle.height) {
    return false;
  }
  const Area area{
      .low = {static_cast<std::uint32_t>(rectangle.x), static_cast<std::uint32_t>(rectangle.y)},
      .high = {static_cast<std::uint32_t>(rectangle.x + rectangle.width - 1),
               static_cast<std::uint32_t>(rectangle.y + rectangle.height - 1)}};
  for (std::uint32_t y = area.low[1] & ~kTileMask; y <= area.high[1]; y += kTileSide) {
    for (std::uint32_t x = area.low[0] & ~kTileMask; x <= area.high[0]; x += kTileSide) {
      if (!is_free_in_tile({x, y}, area)) {
        return false;
      }
    }
  }
  return true;
}

bool LinearQuadtree::is_free_in_tile(const Cell& corner, const Area& area) const {
  const Entry& entry = entries_[morton_place(corner, kGridSideLog2) / kTileCells];
  if (entry.record == kNoRecord) {
    return entry.index < 0;
  }
  const TileRecord& record = records_[entry.record];
  for (std::size_t quarter = 0; quarter < record.shape.size(); ++quarter) {
    const Cell low = quarter_corner(corner, quarter);
    if (!area.meets({low, kQuarterSideLog2})) {
      continue;
    }
    QuarterLeaves leaves(record.shape[quarter], leaves_of(record, quarter));
    for (; !leaves.at_end(); leaves.next()) {
      if (leaves.index() >= 0 && area.meets(leaves.block(low))) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace iog::tree
