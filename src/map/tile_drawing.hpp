// Draws one tile of the window from a block. The drawing determines which classes each cell of the
// tile may have.
//
// A cell's own classes are the classes of all features that contain its centre. If no feature
// contains the centre, the cell's own class is `intermediate`. Outside the extent of the block, any
// class is possible. The possible classes of a cell are its own classes and those of all cells
// within the radius. A drawing can be suspended. The result is available only when the drawing is
// complete.
#pragma once

#include <cstdint>
#include <optional>

#include "map/block.hpp"
#include "map/raster.hpp"
#include "map/tile_mask.hpp"
#include "map/tile_place.hpp"

namespace iog::map {

// The cost of an edge that crosses a row of the frame. An edge that crosses no row costs 1 unit.
inline constexpr std::uint32_t kWorkPerCrossing = 8;

class TileDrawing {
 public:
  // The bytes of the block must outlive the drawing. `is_outside()` must be false for the tile.
  // `radius` is in cells, 0 ... kHalo.
  TileDrawing(const Block& block, const TilePlace& place, std::int32_t radius);

  // Returns true if the tile and all cells within the radius are outside the extent. In this case,
  // the cells of the tile may have any class.
  [[nodiscard]] static bool is_outside(const Block& block, const TilePlace& place,
                                       std::int32_t radius) {
    return !place.box(radius).meets(block.extent());
  }

  // Continues until the budget is used up or the drawing is complete. Returns true if the drawing
  // is complete. Each entry in the block's index costs 1 unit. The edges of a feature are examined
  // only if its box overlaps the tile or the cells within the radius. An edge costs
  // kWorkPerCrossing units if it crosses a row, and 1 unit otherwise. However, an edge never costs
  // more than the remaining budget.
  [[nodiscard]] bool go_on(std::uint32_t& budget);

  // Returns the mask. The mask is valid only when the drawing is complete.
  [[nodiscard]] TileMask mask();

 private:
  void take_edges(std::uint32_t& budget);
  [[nodiscard]] FrameBits outside();

  TilePlace place_;
  std::int32_t radius_;
  BoxCm extent_;
  bool is_inside_;  // the tile and its surroundings are within the extent
  FeatureWalk features_;
  std::optional<EdgeWalk> edges_;  // of the current feature
  Kind kind_ = Kind::kBuilding;    // of the current feature
  Raster raster_;
  FrameBits buildings_{};
  FrameBits roads_{};
};

}  // namespace iog::map
