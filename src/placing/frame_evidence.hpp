// The evidence of a frame. The slices of the frame are merged into the cells of the window.
//
// Free space is gathered: the negative index of a slice cell is added to each window cell whose
// centre lies in the slice cell. Hits are scattered: the positive index of a slice cell is added to
// the window cell that contains the centre of the slice cell. If hits were also gathered, thin
// objects such as poles could be lost, because some slice cells (17 % at 45 degrees) do not contain
// the centre of any window cell. Hits outside the window are dropped.
//
// The evidence of a cell is the saturating sum of its positive indexes. If the cell has no positive
// index, the evidence is the saturating sum of its negative indexes. One byte per cell is enough
// for both sums (placing/slice_byte.hpp). A positive byte contains only the sum of hits, because
// the first hit overwrites the free index. Slices may be added in any order because a saturating
// sum of numbers with the same sign does not depend on their order. The extra bit of a free cell is
// set if any slice sets it. A second bit per cell is set if a hit in the cell is a tall return. The
// evidence takes up 1.1 MB in total.
//
// If several cores add slices, each core processes some regions of the window. The core that
// processes a region gathers free space into the region's tiles and searches the slices for hits in
// the region. If there is only one core, it processes the entire window as one region.
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

// A slice, and the pose of the vehicle when the slice was measured.
struct PlacedCells {
  const SliceCells* cells = nullptr;
  Placement at{};
  std::uint8_t number = 0;  // number of the slice in its frame
};

class FrameEvidence {
 public:
  using TileIndexes = std::array<std::int8_t, geometry::kTileCells>;

  // The maximum number of slices per call. A frame of 40 ms has at most this many slices, each at
  // most 8 ms long.
  static constexpr std::size_t kMostAtOnce = 6;

  // Adds at most kMostAtOnce slices. The vehicle must be inside the area, and the area must not
  // change within a frame. While slices are added, core 0 runs `beside`, which may read the slices.
  void add(std::span<const PlacedCells> slices, const window::Area& area,
           const work::Crew& crew = work::Crew(), work::Beside beside = {});
  void add(const SliceCells& slice, const window::Area& area, const Placement& at) {
    const PlacedCells only{.cells = &slice, .at = at};
    add(std::span(&only, 1), area);
  }

  // Clear all evidence, or only the evidence of the tile in a slot.
  void clear();
  void clear(std::size_t slot);

  // Returns true if any cell of the tile in this slot has evidence.
  [[nodiscard]] bool is_touched(std::size_t slot) const { return is_touched_[slot]; }

  // Returns true if any cell of the tile in this slot was hit.
  [[nodiscard]] bool has_hit(std::size_t slot) const { return has_hit_[slot]; }

  // Returns the merged bytes of the tile in a slot, row by row from the lowest y. The result is
  // valid only if the tile has been touched.
  [[nodiscard]] const TileIndexes& tile(std::size_t slot) const { return cells_[slot]; }

  // Returns the tile's cells that contain a tall return. The result is valid only if the tile has
  // been touched.
  [[nodiscard]] const window::Plane& tall(std::size_t slot) const { return tall_[slot]; }

  // Removes the evidence from the given cells of the tile in a slot.
  void leave_out(std::size_t slot, const window::Plane& cells);

 private:
  // A rectangle of tiles of the window. Tiles are counted from the window's lowest corner.
  struct Region {
    window::TileNumber low{};
    window::Extent extent{};

    [[nodiscard]] bool contains(geometry::Cell cell) const {
      return extent.cells().contains(
          geometry::Cell{cell.x - low.a * window::kTileSide, cell.y - low.b * window::kTileSide});
    }
    [[nodiscard]] window::TileNumber tile(std::size_t i) const {
      const auto number = static_cast<std::int32_t>(i);
      return {low.a + number % extent.columns, low.b + number / extent.columns};
    }
    // Returns true if the rectangle from low_cell to high_cell overlaps the region.
    [[nodiscard]] bool meets(geometry::Cell low_cell, geometry::Cell high_cell) const {
      return (high_cell.x >> geometry::kTileSideLog2) >= low.a &&
             (low_cell.x >> geometry::kTileSideLog2) < low.a + extent.columns &&
             (high_cell.y >> geometry::kTileSideLog2) >= low.b &&
             (low_cell.y >> geometry::kTileSideLog2) < low.b + extent.rows;
    }
  };
  // The side length of a region, in tiles, if several cores are used. Regions are large enough that
  // few hits are examined for more than one region, and small enough that no core waits long for
  // the last region. Regions at the upper edges of the window may be smaller.
  static constexpr std::int32_t kRegionAcross = 4;
  static constexpr std::size_t kRegionTiles = std::size_t{kRegionAcross} * kRegionAcross;
  static constexpr std::int32_t regions_along(std::int32_t tiles) {
    return (tiles + kRegionAcross - 1) / kRegionAcross;
  }
  static Region region_of(const window::Extent& window, std::size_t item);

  // The undo log of a region. The cells of untouched tiles are not stored.
  struct Before {
    std::array<bool, kRegionTiles> is_touched{};
    std::array<bool, kRegionTiles> has_hit{};
    alignas(32) std::array<TileIndexes, kRegionTiles> cells{};
    std::array<window::Plane, kRegionTiles> tall{};
  };

  // A slice that is being added, with its transforms.
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
  void touch(std::size_t slot);

  alignas(32) std::array<TileIndexes, window::kSlotCount> cells_{};
  std::array<window::Plane, window::kSlotCount> tall_{};
  std::array<bool, window::kSlotCount> is_touched_{};
  std::array<bool, window::kSlotCount> has_hit_{};
  work::BeforeImages<Before> before_;
};

}  // namespace iog::placing
