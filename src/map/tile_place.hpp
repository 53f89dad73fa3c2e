// Transforms coordinates between a tile of the window and the plane of a map.
//
// Vertices are rounded to fine units. A cell is kFine units wide, so a unit is 0.4 mm long if cells
// are 0.1 m wide. Cell sizes are 50, 100, 200 or 500 mm. The origin of fine coordinates is the
// corner of the tile's frame with the lowest x and y. The frame consists of the tile and a margin
// of kHalo cells on each side. The rounding depends only on the position in the local frame. A
// vertex therefore has the same rounded position in all tiles and features.
#pragma once

#include <cstdint>

#include "geometry/sizes.hpp"
#include "map/plane.hpp"
#include "pose/pose.hpp"
#include "window/area.hpp"

namespace iog::map {

// The width of a tile's margin in cells. Features in this margin can affect the tile.
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

// Contains every point `p` with `low <= p <= high` in both coordinates.
struct FineBox {
  FinePoint low;
  FinePoint high;
};

class TilePlace {
 public:
  // `local_frame` is the pose of the local frame in the plane of the map. The absolute values of
  // its coordinates must not exceed pose::kMaxCoordinateMm.
  TilePlace(const pose::Pose& local_frame, window::TileNumber tile,
            std::int32_t cell_mm = geometry::kCellMm);

  // Converts a vertex to fine units. The vertex must lie within the extent of a map, and the tile's
  // box must overlap this extent.
  [[nodiscard]] FinePoint fine(PointCm point) const;

  // Returns the smallest box in fine units that contains all of `box`.
  [[nodiscard]] FineBox fine_box(const BoxCm& box) const;

  // Returns a box in the plane of the map that contains the tile and `cells_around` cells on each
  // side of it.
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

// Returns true if any corner of the tile moves by more than one cell in the plane of the map when
// the pose changes from `from` to `to`. The movement is computed to within 2^-10 mm.
[[nodiscard]] bool has_moved(window::TileNumber tile, const pose::Pose& from, const pose::Pose& to,
                             std::int32_t cell_mm = geometry::kCellMm);

}  // namespace iog::map
