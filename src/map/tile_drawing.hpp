// One tile of the window, drawn from a block: what each of its cells can be.
//
// A cell's own classes are those of the features that hold its centre, all of them, or intermediate
// space; outside of the block's extent it can be anything. A cell can be what any cell within the
// radius is by itself. A drawing can be left and gone on with, and is nothing before it is whole.
#pragma once

#include <cstdint>
#include <optional>

#include "map/block.hpp"
#include "map/raster.hpp"
#include "map/tile_mask.hpp"
#include "map/tile_place.hpp"

namespace iog::map {

// An edge that crosses a row of the frame is as much work as so many that do not.
inline constexpr std::uint32_t kWorkPerCrossing = 8;

class TileDrawing {
 public:
  // The block's bytes outlive it. The tile is not outside. radius: in cells, 0 ... kHalo.
  TileDrawing(const Block& block, const TilePlace& place, std::int32_t radius);

  // Whether no cell within the radius is in the extent: all of the tile can be anything.
  [[nodiscard]] static bool is_outside(const Block& block, const TilePlace& place,
                                       std::int32_t radius) {
    return !place.box(radius).meets(block.extent());
  }

  // Goes on until the budget is used up or the drawing is whole; returns whether it is. Takes one
  // from the budget for each entry of the block's index and for each edge of a feature whose box
  // reaches the tile's rows and columns, and kWorkPerCrossing, or what is left, for each edge that
  // crosses.
  [[nodiscard]] bool go_on(std::uint32_t& budget);

  // Of a drawing that is whole.
  [[nodiscard]] TileMask mask();

 private:
  void take_edges(std::uint32_t& budget);
  [[nodiscard]] FrameBits outside();

  TilePlace place_;
  std::int32_t radius_;
  BoxCm extent_;
  bool is_inside_;  // in the extent, with all that is near
  FeatureWalk features_;
  std::optional<EdgeWalk> edges_;  // of the feature that is being drawn
  Kind kind_ = Kind::kBuilding;    // its
  Raster raster_;
  FrameBits buildings_{};
  FrameBits roads_{};
};

}  // namespace iog::map
