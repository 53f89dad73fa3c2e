// The evidence of a frame in the window: what its slices say of each cell, joined.
//
// Free is pulled: a cell of the window takes the negative index of the vehicle's cell that holds
// its centre. Hits are pushed: a vehicle's cell with a positive index gives it to the cell of the
// window that holds its centre, because some cells of the vehicle's grid hold no centre (17 % at 45
// degrees), and a pole must not vanish. What lies outside of the window is dropped.
//
// A cell's evidence is the saturated sum of the positive indexes if there are any, else of the
// negative ones. A byte is enough for both (placing/slice_byte.hpp): what is above zero counts hits
// alone, and the first hit erases what was pulled. Sums of one sign saturate alike in any order,
// and the bit of a free cell is that of any slice, so slices may come in any. Whether a hit was
// tall is a bit a cell of its own. The window bounds it all, by slot, 1.1 MB.
//
// Several cores add slices region by region of the window: whoever has a region pulls its tiles
// and looks through the slices for what is pushed into it. One core alone takes all of the window
// as one region.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "placing/look_up.hpp"
#include "placing/placement.hpp"
#include "placing/slice_cells.hpp"
#include "window/area.hpp"
#include "work/before_images.hpp"
#include "work/crew.hpp"

namespace iog::placing {

// A slice and where the vehicle was then.
struct PlacedCells {
  const SliceCells* cells = nullptr;
  Placement at{};
  std::uint8_t number = 0;  // of the slice in its frame
};

class FrameEvidence {
 public:
  using TileIndexes = std::array<std::int8_t, geometry::kTileCells>;

  // As many slices as are added at once: those of a frame of 40 ms, each of 8 ms or a part of it.
  static constexpr std::size_t kMostAtOnce = 6;

  // Adds slices, at most kMostAtOnce. The vehicle is inside of the area, which stays the same for a
  // frame. Core 0 does what is beside it, which may read the slices.
  void add(std::span<const PlacedCells> slices, const window::Area& area,
           const work::Crew& crew = work::Crew(), work::Beside beside = {});
  void add(const SliceCells& slice, const window::Area& area, const Placement& at) {
    const PlacedCells only{.cells = &slice, .at = at};
    add(std::span(&only, 1), area);
  }

  // Nothing is said of any cell, and of any of the tile at a slot.
  void clear();
  void clear(std::size_t slot);

  // Whether anything was said of a cell of the tile at this slot.
  [[nodiscard]] bool is_touched(std::size_t slot) const { return is_touched_[slot]; }

  // Whether a cell of it was hit.
  [[nodiscard]] bool has_hit(std::size_t slot) const { return has_hit_[slot]; }

  // The joined bytes of the tile at a slot, row by row from the lowest y.
  [[nodiscard]] const TileIndexes& tile(std::size_t slot) const { return cells_[slot]; }

  // Its cells in which a hit was tall. Only if it is touched.
  [[nodiscard]] const window::Plane& tall(std::size_t slot) const { return tall_[slot]; }

  // Nothing is said any more of these cells of the tile at a slot.
  void leave_out(std::size_t slot, const window::Plane& cells);

 private:
  // Some tiles of the window, counted from its lowest corner.
  struct Region {
    window::TileNumber low{};
    std::int32_t tiles_across = window::kTilesAcross;

    [[nodiscard]] bool contains(geometry::Cell cell) const {
      const std::int32_t side = tiles_across * window::kTileSide;
      return geometry::CellArea{side, side}.contains(
          geometry::Cell{cell.x - low.a * window::kTileSide, cell.y - low.b * window::kTileSide});
    }
    [[nodiscard]] window::TileNumber tile(std::size_t i) const {
      const auto number = static_cast<std::int32_t>(i);
      return {low.a + number % tiles_across, low.b + number / tiles_across};
    }
    // Whether it may have a cell from low_cell to high_cell.
    [[nodiscard]] bool meets(geometry::Cell low_cell, geometry::Cell high_cell) const {
      return (high_cell.x >> geometry::kTileSideLog2) >= low.a &&
             (low_cell.x >> geometry::kTileSideLog2) < low.a + tiles_across &&
             (high_cell.y >> geometry::kTileSideLog2) >= low.b &&
             (low_cell.y >> geometry::kTileSideLog2) < low.b + tiles_across;
    }
  };
  // Of several cores: large enough that few hits are looked at for two of them, and so many that
  // nobody waits long for the last.
  static constexpr std::int32_t kRegionAcross = 4;
  static constexpr std::int32_t kRegionsAcross = window::kTilesAcross / kRegionAcross;
  static constexpr std::size_t kRegionCount = std::size_t{kRegionsAcross} * kRegionsAcross;
  static constexpr std::size_t kRegionTiles = std::size_t{kRegionAcross} * kRegionAcross;
  static Region region_of(std::size_t item);

  // A region before slices were added to it. Of a tile that was not touched the cells were 0.
  struct Before {
    std::array<bool, kRegionTiles> is_touched{};
    std::array<bool, kRegionTiles> has_hit{};
    alignas(32) std::array<TileIndexes, kRegionTiles> cells{};
    std::array<window::Plane, kRegionTiles> tall{};
  };

  // A slice on its way into the window.
  struct Adding {
    Adding(const PlacedCells& slice_of, const window::Area& its_area)
        : slice(slice_of.cells),
          area(&its_area),
          to_grid(CellMap::to_grid(its_area, slice_of.at)),
          steps(to_grid.step()),
          to_window(CellMap::to_window(its_area, slice_of.at)) {}

    [[nodiscard]] std::size_t slot_at(window::TileNumber in_window) const {
      return slot_in(*area, in_window);
    }

    const SliceCells* slice;
    const window::Area* area;
    CellMap to_grid;
    EightSteps steps;
    CellMap to_window;
  };
  using Addings = std::array<std::optional<Adding>, kMostAtOnce>;

  [[nodiscard]] static std::size_t slot_in(const window::Area& area, window::TileNumber in_window) {
    return window::slot_of({area.corner().a + in_window.a, area.corner().b + in_window.b});
  }

  void keep_before(const window::Area& area, std::size_t item, std::size_t core);
  void remember(const window::Area& area, const Region& region, Before& before) const;
  void put_back(const window::Area& area, const Region& region, const Before& before);
  void add_to(const Region& region, const Addings& addings);
  void pull(const Adding& adding, const Region& region);
  void push(const Adding& adding, const Region& region);
  void push_hit(const Adding& adding, geometry::Cell cell, std::int8_t byte);

  alignas(32) std::array<TileIndexes, window::kSlotCount> cells_{};
  std::array<window::Plane, window::kSlotCount> tall_{};
  std::array<bool, window::kSlotCount> is_touched_{};
  std::array<bool, window::kSlotCount> has_hit_{};
  work::BeforeImages<Before> before_;
};

}  // namespace iog::placing
