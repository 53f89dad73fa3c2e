// Draws one tile of the window from a block: determines the classes that each cell of the tile may
// have.
//
// A cell's own classes are the classes of all features that contain the cell's centre. If no
// feature contains it, the cell's own class is intermediate space. Outside the extent of the block,
// any class is possible. A cell may have all classes that any cell within the radius has as its own
// class. A drawing can be suspended. It has no result until it is complete.
#pragma once

#include <cstdint>
#include <optional>

#include "map/block.hpp"
#include "map/raster.hpp"
#include "map/tile_mask.hpp"
#include "map/tile_place.hpp"

namespace iog::map {

// The cost of an edge that crosses a row of the frame, relative to an edge that crosses no row.
inline constexpr std::uint32_t kWorkPerCrossing = 8;

class TileDrawing {
 public:
  // The bytes of the block must outlive the drawing. is_outside() must be false for the tile.
  // `radius` is in cells, 0 ... kHalo.
  TileDrawing(const Block& block, const TilePlace& place, std::int32_t radius);

  // Whether all cells within the radius are outside the extent. In this case, all cells of the tile
  // may have any class.
  [[nodiscard]] static bool is_outside(const Block& block, const TilePlace& place,
                                       std::int32_t radius) {
    return !place.box(radius).meets(block.extent());
  }

  // Continues until the budget is used up or the drawing is complete. Returns whether the drawing
  // is complete. An entry of the block's index costs 1. An edge of a feature whose box reaches the
  // tile's rows and columns also costs 1. If the edge crosses a row, it costs kWorkPerCrossing
  // instead, but at most the remaining budget.
  [[nodiscard]] bool go_on(std::uint32_t& budget);

  // Valid only when the drawing is complete.
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
