// Ranges. A stored index is -127 ... 127, and so is one of a slice. Points are below 2^13 cells,
// which are 2^29 of 2^-16 cells (placement.cpp), and so are sums of a point and 62 steps of at most
// 2^16.
#include "window/frame_evidence.hpp"

#include <algorithm>

#include "window/eight_bytes.hpp"

namespace iog::window {
namespace {

constexpr std::int32_t kLast = kTileSide - 1;
constexpr std::int8_t kLeast = -127;
constexpr std::int32_t kMost = 127;

// The cells of the vehicle's grid in which the centres of a tile's cells lie at most: low and high
// are both included.
struct Reach {
  geometry::Cell low;
  geometry::Cell high;

  static Reach of_tile(FinePoint first, FinePoint step) {
    const std::int32_t along = kLast * step.x;
    const std::int32_t aside = kLast * step.y;
    const FinePoint low{first.x + less(along) - more(aside), first.y + less(aside) + less(along)};
    const FinePoint high{first.x + more(along) - less(aside), first.y + more(aside) + more(along)};
    return {low.cell(), high.cell()};
  }

  [[nodiscard]] bool is_inside_grid() const {
    return geometry::kGridArea.contains(low) && geometry::kGridArea.contains(high);
  }

  // Whether something is known in one of the grid's tiles that it touches.
  [[nodiscard]] bool is_known(const SliceCells& slice) const {
    constexpr auto kEnd = static_cast<std::int32_t>(geometry::kTilesPerSide);
    const geometry::Cell first{more(low.x) / kTileSide, more(low.y) / kTileSide};
    const geometry::Cell last{high.x >> geometry::kTileSideLog2, high.y >> geometry::kTileSideLog2};
    for (std::int32_t y = first.y; y <= last.y && y < kEnd; ++y) {
      for (std::int32_t x = first.x; x <= last.x && x < kEnd; ++x) {
        const std::int32_t tile = y * kEnd + x;
        if (slice.is_known(static_cast<std::size_t>(tile))) {
          return true;
        }
      }
    }
    return false;
  }

 private:
  static std::int32_t less(std::int32_t a) { return a < 0 ? a : 0; }
  static std::int32_t more(std::int32_t a) { return a > 0 ? a : 0; }
};

using Row = std::array<std::int8_t, geometry::kTileSide>;

// The indexes that a row of the window's cells finds in the grid; 0 outside of it.
template <bool kMayBeOutside>
void look_up(const SliceCells& slice, FinePoint point, FinePoint step, Row& row) {
  const std::int8_t* cells = slice.cells();
  for (std::int8_t& index : row) {
    const geometry::Cell cell = point.cell();
    point = along_x(point, step);
    if (kMayBeOutside && !geometry::kGridArea.contains(cell)) {
      index = 0;
    } else {
      constexpr std::int32_t kStride = SliceCells::kStride;
      index = cells[cell.y * kStride + cell.x];
    }
  }
}

// The larger of `before` and kLeast - index plus the index is their sum, never less than kLeast,
// and nothing on the way leaves eight bits.
void join_free(const Row& row, std::int8_t* evidence) {
  for (std::size_t x = 0; x < row.size(); ++x) {
    const std::int8_t before = evidence[x];
    const std::int8_t negative = row[x] < 0 ? row[x] : std::int8_t{0};
    const std::int8_t index = before > 0 ? std::int8_t{0} : negative;
    const auto least = static_cast<std::int8_t>(kLeast - index);
    evidence[x] = static_cast<std::int8_t>((before > least ? before : least) + index);
  }
}

void join_hit(std::int32_t index, std::int8_t& evidence) {
  evidence = static_cast<std::int8_t>(std::min(std::max<std::int32_t>(evidence, 0) + index, kMost));
}

}  // namespace

void FrameEvidence::clear() {
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    if (is_touched_[slot]) {
      is_touched_[slot] = false;
      has_hit_[slot] = false;
      cells_[slot].fill(0);
    }
  }
}

void FrameEvidence::pull(const SliceCells& slice, const Area& area, const CellMap& map) {
  const FinePoint step = map.step();
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    const TileNumber tile = area.tile_at(slot);
    const geometry::Cell first_cell{(tile.a - area.corner().a) * kTileSide,
                                    (tile.b - area.corner().b) * kTileSide};
    FinePoint first = map.exact(first_cell);
    const Reach reach = Reach::of_tile(first, step);
    if (!reach.is_known(slice)) {
      continue;
    }
    is_touched_[slot] = true;
    const auto look_up_row = reach.is_inside_grid() ? look_up<false> : look_up<true>;
    for (std::size_t y = 0; y < geometry::kTileSide; ++y, first = along_y(first, step)) {
      Row row;
      look_up_row(slice, first, step, row);
      join_free(row, &cells_[slot][y * geometry::kTileSide]);
    }
  }
}

void FrameEvidence::push(const SliceCells& slice, const Area& area, const CellMap& map) {
  for (std::size_t tile = 0; tile < geometry::kTileCount; ++tile) {
    if (slice.is_known(tile)) {
      push_tile(slice, tile, area, map);
    }
  }
}

void FrameEvidence::push_tile(const SliceCells& slice, std::size_t tile, const Area& area,
                              const CellMap& map) {
  constexpr std::size_t kEight = EightBytes::kCount;
  constexpr auto kSide = static_cast<std::int32_t>(geometry::kTilesPerSide);
  const auto number = static_cast<std::int32_t>(tile);
  const geometry::Cell first{number % kSide * kTileSide, number / kSide * kTileSide};
  const FinePoint step = map.step();
  const std::int8_t* row = slice.cells() + SliceCells::first_of(tile);
  FinePoint at_row = map.exact(first);
  for (std::int32_t y = 0; y < kTileSide; ++y, row += SliceCells::kStride) {
    FinePoint at = at_row;
    for (std::size_t x = 0; x < geometry::kTileSide; x += kEight) {
      if (EightBytes::load(row + x).has_positive()) {
        push_eight(row + x, at, step, area);
      }
      at = {at.x + std::int32_t{kEight} * step.x, at.y + std::int32_t{kEight} * step.y};
    }
    at_row = along_y(at_row, step);
  }
}

void FrameEvidence::push_eight(const std::int8_t* indexes, FinePoint first, FinePoint step,
                               const Area& area) {
  for (std::size_t i = 0; i < EightBytes::kCount; ++i, first = along_x(first, step)) {
    const geometry::Cell cell = first.cell();
    if (indexes[i] <= 0 || !kWindowCells.contains(cell)) {
      continue;
    }
    const std::size_t slot = slot_of({area.corner().a + (cell.x >> geometry::kTileSideLog2),
                                      area.corner().b + (cell.y >> geometry::kTileSideLog2)});
    constexpr std::uint32_t kInTile = kTileSide - 1;
    const auto x = static_cast<std::uint32_t>(cell.x) & kInTile;
    const auto y = static_cast<std::uint32_t>(cell.y) & kInTile;
    is_touched_[slot] = true;
    has_hit_[slot] = true;
    join_hit(indexes[i], cells_[slot][y * geometry::kTileSide + x]);
  }
}

}  // namespace iog::window
