// Affine transforms of cell centres between the slice grid and the window, in units of 2^-16 cells.
//
// The image of the first cell of a tile is computed exactly and rounded down. The images of the
// other cells of the tile are computed by adding steps that are rounded to the nearest 2^-16 cells.
// The computed x and y are therefore too low by less than 32 * 2^-16 cells, or too high by at most
// 31 * 2^-16 cells. If a cell is 0.1 m wide, 32 * 2^-16 cells are 0.05 mm. The window and the slice
// grid have cells of the same size.
#pragma once

#include <algorithm>
#include <cstdint>

#include "geometry/cell.hpp"
#include "geometry/grid.hpp"
#include "numeric/rotation.hpp"
#include "pose/pose.hpp"
#include "window/area.hpp"

namespace iog::placing {

// The transform of a slice. It is given by the vehicle's pose when the slice was measured, and by
// the vehicle's position in the grid.
struct Placement {
  pose::Pose pose{};
  numeric::Rotation rotation{};  // from the heading of the pose
  geometry::Grid grid{};
};

[[nodiscard]] inline Placement placement_of(const pose::Pose& pose,
                                            const geometry::Grid& grid = {}) {
  return {.pose = pose, .rotation = numeric::rotation_of(pose.heading), .grid = grid};
}

inline constexpr int kFineBits = 16;
inline constexpr int kExactBits = 31;

// A point in units of 2^-16 cells.
struct FinePoint {
  std::int32_t x = 0;
  std::int32_t y = 0;

  [[nodiscard]] constexpr geometry::Cell cell() const { return {x >> kFineBits, y >> kFineBits}; }
};

// A point in units of 2^-31 cells.
struct ExactPoint {
  std::int64_t x = 0;
  std::int64_t y = 0;

  [[nodiscard]] constexpr FinePoint fine() const {
    constexpr int kDropped = kExactBits - kFineBits;
    return {static_cast<std::int32_t>(x >> kDropped), static_cast<std::int32_t>(y >> kDropped)};
  }
};

class CellMap {
 public:
  // Returns the transform from window cells to the slice grid. Window cells are counted from the
  // corner of the window. The vehicle must be inside the area.
  [[nodiscard]] static CellMap to_grid(const window::Area& area, const Placement& at);

  // Returns the transform from cells of the slice grid to window cells. The vehicle must be inside
  // the area.
  [[nodiscard]] static CellMap to_window(const window::Area& area, const Placement& at);

  // Returns the image of the centre of a cell. The cell must be the first cell of a tile.
  [[nodiscard]] FinePoint exact(geometry::Cell cell) const { return exactly(cell).fine(); }
  [[nodiscard]] ExactPoint exactly(geometry::Cell cell) const {
    return {x_ + 2 * (cos_ * cell.x - sin_ * cell.y), y_ + 2 * (sin_ * cell.x + cos_ * cell.y)};
  }

  // Move a point in the target grid by one tile along x or y of the source grid, without rounding.
  [[nodiscard]] ExactPoint a_tile_along_x(ExactPoint at) const {
    return {at.x + kTwoTiles * cos_, at.y + kTwoTiles * sin_};
  }
  [[nodiscard]] ExactPoint a_tile_along_y(ExactPoint at) const {
    return {at.x - kTwoTiles * sin_, at.y + kTwoTiles * cos_};
  }

  // Returns a one-cell step along x of the source grid, transformed into the target grid. If this
  // step is (x, y), the step along y is (-y, x).
  [[nodiscard]] FinePoint step() const { return {rounded(cos_), rounded(sin_)}; }

 private:
  static constexpr std::int64_t kTwoTiles = 2 * std::int64_t{window::kTileSide};

  CellMap(std::int64_t x, std::int64_t y, std::int64_t cos_q30, std::int64_t sin_q30)
      : x_(x), y_(y), cos_(cos_q30), sin_(sin_q30) {}

  static constexpr std::int32_t rounded(std::int64_t q30) {
    constexpr int kDropped = 30 - kFineBits;
    return static_cast<std::int32_t>((q30 + (1 << (kDropped - 1))) >> kDropped);
  }

  std::int64_t x_;  // the image of cell (0, 0), in 2^-31 cells
  std::int64_t y_;
  std::int64_t cos_;
  std::int64_t sin_;
};

// Moves a point in the target grid by one step along x or y of the source grid.
[[nodiscard]] constexpr FinePoint along_x(FinePoint point, FinePoint step) {
  return {point.x + step.x, point.y + step.y};
}
[[nodiscard]] constexpr FinePoint along_y(FinePoint point, FinePoint step) {
  return {point.x - step.y, point.y + step.x};
}

// The bounding box of the image of a rectangle of cells, relative to the image of the first cell.
// Both bounds are inclusive.
struct Reach {
  FinePoint to_low;
  FinePoint to_high;

  static Reach of_square(std::int32_t side, FinePoint step) { return of(side, side, step); }
  static Reach of(std::int32_t columns, std::int32_t rows, FinePoint step) {
    const FinePoint across{(columns - 1) * step.x, (columns - 1) * step.y};
    const FinePoint up{-(rows - 1) * step.y, (rows - 1) * step.x};
    constexpr std::int32_t kHere = 0;
    return {.to_low = {std::min(across.x, kHere) + std::min(up.x, kHere),
                       std::min(across.y, kHere) + std::min(up.y, kHere)},
            .to_high = {std::max(across.x, kHere) + std::max(up.x, kHere),
                        std::max(across.y, kHere) + std::max(up.y, kHere)}};
  }

  [[nodiscard]] geometry::Cell low(FinePoint first) const { return along_x(first, to_low).cell(); }
  [[nodiscard]] geometry::Cell high(FinePoint first) const {
    return along_x(first, to_high).cell();
  }
};

}  // namespace iog::placing
