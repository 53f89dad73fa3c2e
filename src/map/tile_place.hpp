// Transforms between a tile of the window and the plane of a map.
//
// Vertices are rounded to fine units, kFine per cell (0.4 mm at 0.1 m), counted from the low corner
// of the tile's frame: the tile with kHalo cells on each side. The rounding depends only on the
// place in the local frame. So a vertex has the same place for all tiles and features, and
// operations on rounded vertices are exact (map/raster.hpp).
#pragma once

#include <cstdint>

#include "geometry/sizes.hpp"
#include "map/plane.hpp"
#include "pose/pose.hpp"
#include "window/area.hpp"

namespace iog::map {

// How many cells around a tile can affect it.
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
  // local_frame: pose of the local frame in the plane of the map, within pose::kMaxCoordinateMm.
  TilePlace(const pose::Pose& local_frame, window::TileNumber tile);

  // A vertex in fine units. It must be in the extent of a map that the tile's box overlaps.
  [[nodiscard]] FinePoint fine(PointCm point) const;

  // The smallest box in the tile's frame that holds the corners of a box, and so all of its
  // contents.
  [[nodiscard]] FineBox fine_box(const BoxCm& box) const;

  // A box of the plane that holds the tile with this many cells around it.
  [[nodiscard]] BoxCm box(std::int32_t cells_around) const;

 private:
  static constexpr int kScaleBits = 25;  // coefficients are in 2^-25 fine units per centimetre

  std::int32_t cos_;
  std::int32_t sin_;
  std::int64_t x_;  // of the plane's origin, plus half a unit
  std::int64_t y_;
  std::int64_t middle_x_mm_;  // centre of the tile, in the plane
  std::int64_t middle_y_mm_;
  std::int64_t slack_mm_;   // error bound of the centre
  std::int64_t reach_q30_;  // half the width of a rotated square of side 2
};

// Whether a corner of the tile has moved by more than a cell in the plane, to 2^-10 mm.
[[nodiscard]] bool has_moved(window::TileNumber tile, const pose::Pose& from, const pose::Pose& to);

}  // namespace iog::map
