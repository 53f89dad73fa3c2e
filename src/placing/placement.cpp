// Ranges: the vehicle is inside the window, so each corner of the window is within 2^20 mm of it
// (1024 cells of at most 500 mm are 512,000 mm), and each cell of the window or of the grid is
// within 2^13 cells (1024 of the window, 4096 of the grid). Then |cos dx + sin dy| < 2^30 * 2^21,
// and twice that fits 63 bits. Positions are below 2^31 * 2^15 in 2^-31 cells and below 2^31 in
// 2^-16 cells.
#include "placing/placement.hpp"

#include "numeric/division.hpp"

namespace iog::placing {
namespace {

static_assert(geometry::kLongestSide <= 4096 && window::kCellsAcross == 1024);

struct Offset {
  std::int64_t x_mm = 0;
  std::int64_t y_mm = 0;
};

// From the window's lowest corner to the vehicle.
Offset vehicle_from_corner(const window::Area& area, const Placement& at) {
  const std::int64_t tile_mm = std::int64_t{window::kTileSide} * at.grid.cell_mm;
  return {at.pose.x_mm - area.corner().a * tile_mm, at.pose.y_mm - area.corner().b * tile_mm};
}

}  // namespace

CellMap CellMap::to_grid(const window::Area& area, const Placement& at) {
  const Offset vehicle = vehicle_from_corner(area, at);
  const std::int64_t cell_mm = at.grid.cell_mm;
  const std::int64_t x_mm = cell_mm / 2 - vehicle.x_mm;  // centre of cell (0, 0)
  const std::int64_t y_mm = cell_mm / 2 - vehicle.y_mm;
  const std::int64_t cos = at.rotation.cos_q30;
  const std::int64_t sin = at.rotation.sin_q30;
  const auto exactly = [](std::uint16_t cells) { return std::int64_t{cells} << kExactBits; };
  return {
      numeric::div_floor(2 * (cos * x_mm + sin * y_mm), cell_mm) + exactly(at.grid.origin_column),
      numeric::div_floor(2 * (cos * y_mm - sin * x_mm), cell_mm) + exactly(at.grid.origin_row), cos,
      -sin};
}

CellMap CellMap::to_window(const window::Area& area, const Placement& at) {
  const Offset vehicle = vehicle_from_corner(area, at);
  const std::int64_t cell_mm = at.grid.cell_mm;
  const std::int64_t cos = at.rotation.cos_q30;
  const std::int64_t sin = at.rotation.sin_q30;
  const std::int64_t twice_x = 1 - 2 * at.grid.origin_column;  // centre of cell (0, 0)
  const std::int64_t twice_y = 1 - 2 * at.grid.origin_row;
  constexpr std::int64_t kOne = std::int64_t{1} << kExactBits;
  return {numeric::div_floor(vehicle.x_mm * kOne, cell_mm) + twice_x * cos - twice_y * sin,
          numeric::div_floor(vehicle.y_mm * kOne, cell_mm) + twice_x * sin + twice_y * cos, cos,
          sin};
}

}  // namespace iog::placing
