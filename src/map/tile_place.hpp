// Where a tile of the window lies in the map's plane, and the map's vertices among its cells.
//
// Vertices are rounded to fine units, kFine of them a cell (0.4 mm at 0.1 m), counted from the low
// corner of the tile's frame: the tile and kHalo cells on each side. The rounding is that of the
// place in the local frame, whichever tile asks. So a vertex is at one place for all tiles and
// features, and what is decided between rounded vertices is exact (map/raster.hpp).
#pragma once

#include <cstdint>

#include "geometry/sizes.hpp"
#include "map/plane.hpp"
#include "pose/pose.hpp"
#include "window/area.hpp"

namespace iog::map {

// Cells around a tile that can matter to it.
inline constexpr std::int32_t kHalo = 16;
inline constexpr std::int32_t kFrameSide = window::kTileSide + 2 * kHalo;
static_assert(kFrameSide == 64, "a row of the frame is a word");

inline constexpr int kFineBits = 8;
inline constexpr std::int32_t kFine = 1 << kFineBits;

// A place in fine units.
struct FinePoint {
  std::int32_t x = 0;
  std::int32_t y = 0;
  friend constexpr bool operator==(const FinePoint&, const FinePoint&) = default;
};

// low <= p <= high, both coordinates.
struct FineBox {
  FinePoint low;
  FinePoint high;
};

class TilePlace {
 public:
  // local_frame: where the local frame is in the map's plane, within pose::kMaxCoordinateMm.
  TilePlace(const pose::Pose& local_frame, window::TileNumber tile);

  // Of a vertex in the extent of a map that the tile's box meets.
  [[nodiscard]] FinePoint fine(PointCm point) const;

  // The least box among the tile's cells that holds the corners of a box, and so all that is in it.
  [[nodiscard]] FineBox fine_box(const BoxCm& box) const;

  // A box of the plane that holds the tile and so many cells around it.
  [[nodiscard]] BoxCm box(std::int32_t cells_around) const;

 private:
  static constexpr int kScaleBits = 25;  // coefficients are in 2^-25 fine units a centimetre

  std::int32_t cos_;
  std::int32_t sin_;
  std::int64_t x_;  // of the plane's origin, and half a unit
  std::int64_t y_;
  std::int64_t middle_x_mm_;  // of the tile, in the plane
  std::int64_t middle_y_mm_;
  std::int64_t slack_mm_;   // by which that may be wrong
  std::int64_t reach_q30_;  // of a square of side 2, as it is turned, to each side
};

// Whether a corner of the tile lies more than a cell from where it lay in the plane, to 2^-10 mm.
[[nodiscard]] bool has_moved(window::TileNumber tile, const pose::Pose& from, const pose::Pose& to);

}  // namespace iog::map
