// Ranges. A stored byte is -63 ... 63, and so is one of a slice. Points are below 2^13 cells,
// which are 2^29 of 2^-16 cells (placement.cpp), and so are sums of a point and 62 steps of at most
// 2^16. Points that are eight steps apart are eight additions of one step apart, exactly. Eight
// by eight cells reach 7 sqrt(2) cells far, and so are within a square of 11 cells of the grid.
#include "window/frame_evidence.hpp"

#include <algorithm>
#include <bit>

#include "require/require.hpp"
#include "window/eight_bytes.hpp"
#include "window/look_up.hpp"
#include "window/reach.hpp"
#include "window/slice_hits.hpp"

namespace iog::window {
namespace {

// Whether something is known in one of the grid's tiles that have a cell from low to high.
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

constexpr std::int32_t kEight = EightBytes::kCount;
static_assert(kEight == SliceCells::kBlockSide);

void clear_block(std::size_t x, Band& band) {
  for (std::size_t row = x; row < band.size(); row += geometry::kTileSide) {
    EightBytes::none().store(&band[row]);
  }
}

// The indexes that a band's cells find in the grid, all of them inside of it. Its blocks of eight
// by eight cells are looked up where something may be known. False if it is nowhere.
bool look_up_inside(const SliceCells& slice, const Reach& block, FinePoint first, FinePoint step,
                    Band& found) {
  bool is_known = false;
  for (std::size_t x = 0; x < geometry::kTileSide; x += kEight) {
    const bool is_near = slice.is_known_near(block.low(first));
    is_known = is_known || is_near;
    if (is_near) {
      look_up_block(slice, first, step, x, found);
    } else {
      clear_block(x, found);
    }
    first = {first.x + kEight * step.x, first.y + kEight * step.y};
  }
  return is_known;
}

// The same of any cells; outside of the grid all indexes are 0.
void look_up_anywhere(const SliceCells& slice, FinePoint first, FinePoint step, Band& found) {
  std::int8_t* out = found.data();
  for (std::int32_t y = 0; y < kEight; ++y, first = along_y(first, step)) {
    FinePoint point = first;
    for (std::int32_t x = 0; x < kTileSide; ++x, point = along_x(point, step)) {
      const geometry::Cell cell = point.cell();
      *out++ = geometry::kGridArea.contains(cell)
                   ? slice.cells()[cell.y * std::int32_t{SliceCells::kStride} + cell.x]
                   : std::int8_t{0};
    }
  }
}

// Two free bytes: their indexes are added, their bits joined. All is of eight bits without a sign,
// so that the compiler does many at once.
void join_free(const Band& found, std::span<std::int8_t, kBandCells> evidence) {
  constexpr std::uint8_t kMost = kMostIndex;
  constexpr std::uint8_t kBit = kBeside;
  const auto freedom = [](std::int8_t byte) {
    return static_cast<std::uint8_t>(byte < 0 ? -byte : 0);
  };
  for (std::size_t i = 0; i < found.size(); ++i) {
    const std::uint8_t before = freedom(evidence[i]);
    const std::uint8_t next = freedom(found[i]);
    const auto sum = static_cast<std::uint8_t>((before & kMost) + (next & kMost));
    const auto bit = static_cast<std::uint8_t>((before | next) & kBit);
    const auto joined = static_cast<std::uint8_t>((sum < kMost ? sum : kMost) | bit);
    evidence[i] = evidence[i] > 0 ? evidence[i] : static_cast<std::int8_t>(-joined);
  }
}

void join_hit(std::int32_t index, std::int8_t& evidence) {
  evidence =
      static_cast<std::int8_t>(std::min(std::max<std::int32_t>(evidence, 0) + index, kMostIndex));
}

}  // namespace

void FrameEvidence::clear() {
  for (std::size_t slot = 0; slot < kSlotCount; ++slot) {
    clear(slot);
  }
}

void FrameEvidence::clear(std::size_t slot) {
  if (is_touched_[slot]) {
    cells_[slot].fill(0);
    tall_[slot].fill(0);
    has_hit_[slot] = false;
    work::keep_order();
    is_touched_[slot] = false;
  }
}

void FrameEvidence::leave_out(std::size_t slot, std::size_t group, std::uint8_t cells) {
  for (unsigned left = cells; left != 0; left &= left - 1) {
    const auto i = static_cast<std::size_t>(std::countr_zero(left));
    cells_[slot][group * evidence::kGroupCells + i] = 0;
  }
}

void FrameEvidence::add(std::span<const PlacedCells> slices, const Area& area,
                        const work::Crew& crew) {
  require(slices.size() <= kMostAtOnce);
  Addings addings;
  for (std::size_t i = 0; i < slices.size(); ++i) {
    addings[i].emplace(slices[i], area);
  }
  if (crew.is_one()) {
    add_to({}, addings);
    return;
  }
  before_.begin();
  crew.share(kRegionCount, [this, &area, &addings](std::size_t item, std::size_t core) {
    keep_before(area, item, core);
    add_to(region_of(item), addings);
  });
}

void FrameEvidence::add_to(const Region& region, const Addings& addings) {
  for (const std::optional<Adding>& adding : addings) {
    if (adding) {
      pull(*adding, region);
      push(*adding, region);
    }
  }
}

FrameEvidence::Region FrameEvidence::region_of(std::size_t item) {
  const auto number = static_cast<std::int32_t>(item);
  return {.low = {number % kRegionsAcross * kRegionAcross, number / kRegionsAcross * kRegionAcross},
          .tiles_across = kRegionAcross};
}

void FrameEvidence::keep_before(const Area& area, std::size_t item, std::size_t core) {
  if (Before* const before = before_.of(core)) {
    remember(area, region_of(item), *before);
    before_.keep(core, item);
  } else if (const Before* const left = before_.of_lost(item)) {
    put_back(area, region_of(item), *left);
  }
}

void FrameEvidence::remember(const Area& area, const Region& region, Before& before) const {
  for (std::size_t i = 0; i < kRegionTiles; ++i) {
    const std::size_t slot = slot_in(area, region.tile(i));
    before.is_touched[i] = is_touched_[slot];
    before.has_hit[i] = has_hit_[slot];
    if (is_touched_[slot]) {
      before.cells[i] = cells_[slot];
      before.tall[i] = tall_[slot];
    }
  }
}

void FrameEvidence::put_back(const Area& area, const Region& region, const Before& before) {
  for (std::size_t i = 0; i < kRegionTiles; ++i) {
    const std::size_t slot = slot_in(area, region.tile(i));
    is_touched_[slot] = before.is_touched[i];
    has_hit_[slot] = before.has_hit[i];
    cells_[slot] = before.is_touched[i] ? before.cells[i] : TileIndexes{};
    tall_[slot] = before.is_touched[i] ? before.tall[i] : Plane{};
  }
}

void FrameEvidence::pull(const Adding& adding, const Region& region) {
  const CellMap& map = adding.to_grid;
  const FinePoint step = map.step();
  const Reach reach = Reach::of_square(kTileSide, step);
  ExactPoint row = map.exactly({region.low.a * kTileSide, region.low.b * kTileSide});
  for (std::int32_t b = 0; b < region.tiles_across; ++b, row = map.a_tile_along_y(row)) {
    ExactPoint tile = row;
    for (std::int32_t a = 0; a < region.tiles_across; ++a, tile = map.a_tile_along_x(tile)) {
      const FinePoint first = tile.fine();
      const geometry::Cell low = reach.low(first);
      const geometry::Cell high = reach.high(first);
      if (is_known_between(*adding.slice, low, high)) {
        pull_tile(*adding.slice,
                  geometry::kGridArea.contains(low) && geometry::kGridArea.contains(high), first,
                  step, adding.slot_at({region.low.a + a, region.low.b + b}));
      }
    }
  }
}

void FrameEvidence::pull_tile(const SliceCells& slice, bool is_inside, FinePoint first,
                              FinePoint step, std::size_t slot) {
  const Reach block = Reach::of_square(kEight, step);
  alignas(8) Band found;
  const std::span cells = cells_[slot];
  for (std::size_t at = 0; at < cells.size(); at += kBandCells) {
    bool is_known = true;
    if (is_inside) {
      is_known = look_up_inside(slice, block, first, step, found);
    } else {
      look_up_anywhere(slice, first, step, found);
    }
    if (is_known) {
      is_touched_[slot] = true;
      join_free(found, cells.subspan(at).first<kBandCells>());
    }
    first = {first.x - kEight * step.y, first.y + kEight * step.x};
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
  constexpr std::uint32_t kInTile = kTileSide - 1;
  const auto x = static_cast<std::uint32_t>(cell.x) & kInTile;
  const auto y = static_cast<std::uint32_t>(cell.y) & kInTile;
  is_touched_[slot] = true;
  has_hit_[slot] = true;
  join_hit(index_of(byte), cells_[slot][y * geometry::kTileSide + x]);
  tall_[slot][y] |= (is_tall(byte) ? 1U : 0U) << x;
}

}  // namespace iog::window
