// Ranges: a stored byte is -63 ... 63, and so is one of a slice. Points are below 2^13 cells, which
// are 2^29 of 2^-16 cells (placement.cpp), and so are sums of a point and 62 steps of at most 2^16.
#include "placing/frame_evidence.hpp"

#include <algorithm>
#include <bit>

#include "placing/slice_hits.hpp"
#include "require/require.hpp"

namespace iog::placing {
namespace {

// Whether a tile of the slice grid that overlaps the cells low ... high is known.
bool is_known_between(const SliceCells& slice, geometry::Cell low, geometry::Cell high) {
  const SliceCells::Extent& known = slice.extent();
  const geometry::Cell first{std::max(low.x >> geometry::kTileSideLog2, known.low.x),
                             std::max(low.y >> geometry::kTileSideLog2, known.low.y)};
  const geometry::Cell last{std::min(high.x >> geometry::kTileSideLog2, known.high.x),
                            std::min(high.y >> geometry::kTileSideLog2, known.high.y)};
  for (std::int32_t y = first.y; y <= last.y; ++y) {
    for (std::int32_t x = first.x; x <= last.x; ++x) {
      if (slice.is_known(geometry::Cell{x, y})) {
        return true;
      }
    }
  }
  return false;
}

void join_hit(std::int32_t index, std::int8_t& evidence) {
  evidence =
      static_cast<std::int8_t>(std::min(std::max<std::int32_t>(evidence, 0) + index, kMostIndex));
}

}  // namespace

void FrameEvidence::clear() {
  for (std::size_t slot = 0; slot < window::kSlotCount; ++slot) {
    clear(slot);
  }
}

void FrameEvidence::clear(std::size_t slot) {
  is_touched_[slot] = false;
  has_hit_[slot] = false;
}

// Stale evidence is overwritten here, not in clear(), because the tile is about to be in the cache.
void FrameEvidence::touch(std::size_t slot) {
  cells_[slot].fill(0);
  tall_[slot].fill(0);
  is_touched_[slot] = true;
}

void FrameEvidence::leave_out(std::size_t slot, const window::Plane& cells) {
  for (std::size_t y = 0; y < cells.size(); ++y) {
    for (std::uint32_t left = cells[y]; left != 0; left &= left - 1) {
      const auto x = static_cast<std::size_t>(std::countr_zero(left));
      cells_[slot][y * geometry::kTileSide + x] = 0;
    }
  }
}

void FrameEvidence::add(std::span<const PlacedCells> slices, const window::Area& area,
                        const work::Crew& crew, work::Beside beside) {
  require(slices.size() <= kMostAtOnce);
  Addings addings;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    addings[i].emplace(slices[i], area);
  }
  if (crew.is_one()) {
    add_to({.extent = area.extent()}, addings);
    beside();
    return;
  }
  before_.begin();
  const auto regions = static_cast<std::size_t>(regions_along(area.extent().columns) *
                                                regions_along(area.extent().rows));
  crew.share(
      regions,
      [this, &area, &addings](std::size_t item, std::size_t core) {
        keep_before(area, item, core);
        add_to(region_of(area.extent(), item), addings);
      },
      beside);
}

void FrameEvidence::add_to(const Region& region, const Addings& addings) {
  for (const std::optional<Adding>& adding : addings) {
    if (adding) {
      pull(*adding, region);
      push(*adding, region);
    }
  }
}

FrameEvidence::Region FrameEvidence::region_of(const window::Extent& window, std::size_t item) {
  const auto number = static_cast<std::int32_t>(item);
  const std::int32_t across = regions_along(window.columns);
  const window::TileNumber low{number % across * kRegionAcross, number / across * kRegionAcross};
  const auto tiles = [](std::int32_t all, std::int32_t first) {
    return static_cast<std::uint8_t>(std::min(kRegionAcross, all - first));
  };
  return {.low = low, .extent = {tiles(window.columns, low.a), tiles(window.rows, low.b)}};
}

void FrameEvidence::keep_before(const window::Area& area, std::size_t item, std::size_t core) {
  if (Before* const before = before_.of(core)) {
    remember(area, region_of(area.extent(), item), *before);
    before_.keep(core, item);
  } else if (const Before* const left = before_.of_lost(item)) {
    put_back(area, region_of(area.extent(), item), *left);
  }
}

void FrameEvidence::remember(const window::Area& area, const Region& region, Before& before) const {
  for (std::size_t i = 0; i < region.extent.tile_count(); ++i) {
    const std::size_t slot = slot_in(area, region.tile(i));
    before.is_touched[i] = is_touched_[slot];
    before.has_hit[i] = has_hit_[slot];
    if (is_touched_[slot]) {
      before.cells[i] = cells_[slot];
      before.tall[i] = tall_[slot];
    }
  }
}

void FrameEvidence::put_back(const window::Area& area, const Region& region, const Before& before) {
  for (std::size_t i = 0; i < region.extent.tile_count(); ++i) {
    const std::size_t slot = slot_in(area, region.tile(i));
    is_touched_[slot] = before.is_touched[i];
    has_hit_[slot] = before.has_hit[i];
    if (before.is_touched[i]) {
      cells_[slot] = before.cells[i];
      tall_[slot] = before.tall[i];
    }
  }
}

void FrameEvidence::pull(const Adding& adding, const Region& region) {
  const CellMap& map = adding.to_grid;
  const Reach reach = Reach::of_square(window::kTileSide, adding.steps.step);
  ExactPoint row =
      map.exactly({region.low.a * window::kTileSide, region.low.b * window::kTileSide});
  for (std::int32_t b = 0; b < region.extent.rows; ++b, row = map.a_tile_along_y(row)) {
    ExactPoint tile = row;
    for (std::int32_t a = 0; a < region.extent.columns; ++a, tile = map.a_tile_along_x(tile)) {
      const FinePoint first = tile.fine();
      const geometry::Cell low = reach.low(first);
      const geometry::Cell high = reach.high(first);
      if (is_known_between(*adding.slice, low, high)) {
        const std::size_t slot = adding.slot_at({region.low.a + a, region.low.b + b});
        const bool was_touched = is_touched_[slot];
        if (!was_touched) {
          touch(slot);
        }
        const bool is_known = pull_tile(*adding.slice, first, adding.steps, cells_[slot]);
        is_touched_[slot] = was_touched || is_known;
      }
    }
  }
}

void FrameEvidence::push(const Adding& adding, const Region& region) {
  for_each_hit(
      *adding.slice, adding.to_window,
      [&](geometry::Cell low, geometry::Cell high) { return region.meets(low, high); },
      [&](geometry::Cell cell, std::int8_t byte) __attribute__((always_inline)) {
        if (region.contains(cell)) {
          push_hit(adding, cell, byte);
        }
      });
}

void FrameEvidence::push_hit(const Adding& adding, geometry::Cell cell, std::int8_t byte) {
  const std::size_t slot =
      adding.slot_at({cell.x >> geometry::kTileSideLog2, cell.y >> geometry::kTileSideLog2});
  constexpr std::uint32_t kInTile = window::kTileSide - 1;
  const auto x = static_cast<std::uint32_t>(cell.x) & kInTile;
  const auto y = static_cast<std::uint32_t>(cell.y) & kInTile;
  if (!is_touched_[slot]) {
    touch(slot);
  }
  has_hit_[slot] = true;
  join_hit(index_of(byte), cells_[slot][y * geometry::kTileSide + x]);
  tall_[slot][y] |= (is_tall(byte) ? 1U : 0U) << x;
}

}  // namespace iog::placing
