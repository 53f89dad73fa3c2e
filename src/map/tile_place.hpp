// Transforms between a tile of the window and the plane of a map.
//
// Vertices are rounded to fine units. Each side of a cell is kFine units long, so a unit is 0.4 mm
// if cells are 0.1 m. Cell sizes are 50, 100, 200 or 500 mm. Fine units are counted from the lower
// corner of the tile's frame. The frame is the tile with kHalo additional cells on each side. The
// rounding depends only on the position in the local frame. A vertex therefore has the same rounded
// position in all tiles and features.
#pragma once

#include <cstdint>

#include "geometry/sizes.hpp"
#include "map/plane.hpp"
#include "pose/pose.hpp"
#include "window/area.hpp"

namespace iog::map {

// The width, in cells, of the margin around a tile in which features can affect the tile.
inline constexpr std::int32_t kHalo = 16;
inline constexpr std::int32_t kFrameSide = window::kTileSide + 2 * kHalo;
static_assert(kFrameSide == 64, "a row of the frame is a word");

inline constexpr int kFineBits = 8;
inline constexpr std::int32_t kFine = 1 << kFineBits;

// A point in fine units.
struct FinePoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend constexpr bool operator==(const FinePoint&, const FinePoint&) = default;
};

// Contains points with low <= p <= high in both coordinates.
struct FineBox {
  FinePoint low;
  FinePoint high;
};

class TilePlace {
 public:
  // `local_frame` is the pose of the local frame in the plane of the map, within
  // pose::kMaxCoordinateMm.
  TilePlace(const pose::Pose& local_frame, window::TileNumber tile,
            std::int32_t cell_mm = geometry::kCellMm);

  // Converts a vertex to fine units. The vertex must lie in the extent of a map, and the tile's box
  // must overlap this extent.
  [[nodiscard]] FinePoint fine(PointCm point) const;

  // Returns the smallest box in the tile's frame that contains the corners of the given box, and
  // therefore the entire box.
  [[nodiscard]] FineBox fine_box(const BoxCm& box) const;

  // Returns a box in the plane that contains the tile and `cells_around` cells on each side of it.
  [[nodiscard]] BoxCm box(std::int32_t cells_around) const;

 private:
  static constexpr int kScaleBits = 25;  // coefficients are in 2^-25 fine units per centimetre

  std::int32_t cos_;
  std::int32_t sin_;
  std::int64_t x_;  // of the plane's origin, plus half a unit
  std::int64_t y_;
  std::int64_t middle_x_mm_;  // centre of the tile, in the plane
  std::int64_t middle_y_mm_;
  std::int64_t slack_mm_;   // upper bound of the centre's error
  std::int64_t reach_q30_;  // half the width of a rotated square of side 2
  std::int32_t cell_mm_;
};

// Returns true if the change of the pose moves any corner of the tile by more than a cell in the
// plane of the map. The result is accurate to 2^-10 mm.
[[nodiscard]] bool has_moved(window::TileNumber tile, const pose::Pose& from, const pose::Pose& to,
                             std::int32_t cell_mm = geometry::kCellMm);

}  // namespace iog::map
