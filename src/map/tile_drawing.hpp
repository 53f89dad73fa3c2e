// Draws one tile of the window from a block: the classes that each of its cells may have.
//
// A cell's own classes are those of all features that hold its centre, or intermediate space if
// there are none. Outside the extent of the block, any class is possible. A cell may have every
// class that a cell within the radius has as its own. A drawing can be suspended, and has no result
// before it is complete.
#pragma once

#include <cstdint>
#include <optional>

#include "map/block.hpp"
#include "map/raster.hpp"
#include "map/tile_mask.hpp"
#include "map/tile_place.hpp"

namespace iog::map {

// Cost of an edge that crosses a row of the frame, relative to one that does not.
inline constexpr std::uint32_t kWorkPerCrossing = 8;

class TileDrawing {
 public:
  // The bytes of the block must outlive the drawing. The tile must not be outside. radius: in
  // cells, 0 ... kHalo.
  TileDrawing(const Block& block, const TilePlace& place, std::int32_t radius);

  // Whether no cell within the radius is in the extent, so the whole tile may have any class.
  [[nodiscard]] static bool is_outside(const Block& block, const TilePlace& place,
                                       std::int32_t radius) {
    return !place.box(radius).meets(block.extent());
  }

  // Continues until the budget is used up or the drawing is complete; returns whether it is
  // complete. An entry of the block's index costs 1. So does an edge of a feature whose box reaches
  // the tile's rows and columns. If the edge crosses a row, it costs kWorkPerCrossing instead, or
  // the rest of the budget.
  [[nodiscard]] bool go_on(std::uint32_t& budget);

  // Valid only when the drawing is complete.
  [[nodiscard]] TileMask mask();

 private:
  void take_edges(std::uint32_t& budget);
  [[nodiscard]] FrameBits outside();

  TilePlace place_;
  std::int32_t radius_;
  BoxCm extent_;
  bool is_inside_;  // the tile with its surroundings is in the extent
  FeatureWalk features_;
  std::optional<EdgeWalk> edges_;  // of the current feature
  Kind kind_ = Kind::kBuilding;    // of the current feature
  Raster raster_;
  FrameBits buildings_{};
  FrameBits roads_{};
};

}  // namespace iog::map
