// Where the centre of a cell lies in another grid, in rational numbers, for a rotation that is
// given in 2^-30.
#pragma once

#include <algorithm>
#include <cstdint>

#include "geometry/grid.hpp"
#include "numeric/division.hpp"
#include "placing/placement.hpp"

namespace iog::tests {

// numerator / denominator cells.
struct ExactCoordinate {
  std::int64_t numerator = 0;
  std::int64_t denominator = 1;

  [[nodiscard]] std::int32_t cell() const {
    return static_cast<std::int32_t>(numeric::div_floor(numerator, denominator));
  }
  // In cells.
  [[nodiscard]] double to_nearest_border() const {
    const std::int64_t above = numerator - cell() * denominator;
    return static_cast<double>(std::min(above, denominator - above)) /
           static_cast<double>(denominator);
  }
};

struct ExactPoint {
  ExactCoordinate x;
  ExactCoordinate y;

  [[nodiscard]] geometry::Cell cell() const { return {x.cell(), y.cell()}; }

  // Whether both coordinates are so far from a border that 32 steps of 2^-16 cells do not matter.
  [[nodiscard]] bool is_clear() const {
    constexpr double kError = 32.0 / 65536;
    return x.to_nearest_border() > kError && y.to_nearest_border() > kError;
  }
};

// The centre of a cell of the local frame, in cells of the vehicle's grid. Within 100 m, the
// products are below 2^30 * 2^18 mm.
inline ExactPoint exact_in_grid(geometry::Cell cell, const placing::Placement& at) {
  const std::int64_t mm = at.grid.cell_mm;
  const std::int64_t denominator = mm << 30;
  const std::int64_t x_mm = cell.x * mm + mm / 2 - at.pose.x_mm;
  const std::int64_t y_mm = cell.y * mm + mm / 2 - at.pose.y_mm;
  const std::int64_t cos = at.rotation.cos_q30;
  const std::int64_t sin = at.rotation.sin_q30;
  return {{at.grid.origin_column * denominator + cos * x_mm + sin * y_mm, denominator},
          {at.grid.origin_row * denominator + cos * y_mm - sin * x_mm, denominator}};
}

// The centre of a cell of the vehicle's grid, in cells of the local frame. Coordinates of 10^9 mm
// are below 2^30 * 2^31.
inline ExactPoint exact_in_frame(geometry::Cell cell, const placing::Placement& at) {
  const std::int64_t mm = at.grid.cell_mm;
  constexpr std::int64_t kOne = std::int64_t{1} << 30;
  const std::int64_t x_mm = (cell.x - at.grid.origin_column) * mm + mm / 2;
  const std::int64_t y_mm = (cell.y - at.grid.origin_row) * mm + mm / 2;
  const std::int64_t cos = at.rotation.cos_q30;
  const std::int64_t sin = at.rotation.sin_q30;
  return {{at.pose.x_mm * kOne + cos * x_mm - sin * y_mm, mm * kOne},
          {at.pose.y_mm * kOne + sin * x_mm + cos * y_mm, mm * kOne}};
}

}  // namespace iog::tests
