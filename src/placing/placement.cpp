// Ranges: the vehicle is inside the window, so each corner of the window is within 2^20 mm of it
// (1024 cells of at most 200 mm are 204,800 mm), and each cell of the window or of the grid is
// within 2^13 cells (1024 of the window, 4096 of the grid). Then |cos dx + sin dy| < 2^30 * 2^21,
// and twice that fits 63 bits. Positions are below 2^31 * 2^15 in 2^-31 cells and below 2^31 in
// 2^-16 cells.
#include "placing/placement.hpp"

#include "numeric/division.hpp"

namespace iog::placing {
namespace {

static_assert(geometry::kCellMm % 2 == 0 && geometry::kCellMm <= 200);
static_assert(geometry::kCellsPerSide <= 4096 && window::kCellsAcross == 1024);

struct Offset {
  std::int64_t x_mm = 0;
  std::int64_t y_mm = 0;
};

// From the window's lowest corner to the vehicle.
Offset vehicle_from_corner(const window::Area& area, const pose::Pose& pose) {
  constexpr std::int64_t kTileMm = std::int64_t{window::kTileSide} * geometry::kCellMm;
  return {pose.x_mm - area.corner().a * kTileMm, pose.y_mm - area.corner().b * kTileMm};
}

}  // namespace

CellMap CellMap::to_grid(const window::Area& area, const Placement& at) {
  const Offset vehicle = vehicle_from_corner(area, at.pose);
  const std::int64_t x_mm = geometry::kCellMm / 2 - vehicle.x_mm;  // centre of cell (0, 0)
  const std::int64_t y_mm = geometry::kCellMm / 2 - vehicle.y_mm;
  const std::int64_t cos = at.rotation.cos_q30;
  const std::int64_t sin = at.rotation.sin_q30;
  constexpr std::int64_t kOrigin = std::int64_t{geometry::kOriginCell} << kExactBits;
  constexpr std::int64_t kCell = geometry::kCellMm;
  return {numeric::div_floor(2 * (cos * x_mm + sin * y_mm), kCell) + kOrigin,
          numeric::div_floor(2 * (cos * y_mm - sin * x_mm), kCell) + kOrigin, cos, -sin};
}

CellMap CellMap::to_window(const window::Area& area, const Placement& at) {
  const Offset vehicle = vehicle_from_corner(area, at.pose);
  const std::int64_t cos = at.rotation.cos_q30;
  const std::int64_t sin = at.rotation.sin_q30;
  constexpr std::int64_t kTwiceCentre = 1 - 2 * geometry::kOriginCell;  // of cell (0, 0)
  constexpr std::int64_t kOne = std::int64_t{1} << kExactBits;
  constexpr std::int64_t kCell = geometry::kCellMm;
  return {numeric::div_floor(vehicle.x_mm * kOne, kCell) + kTwiceCentre * (cos - sin),
          numeric::div_floor(vehicle.y_mm * kOne, kCell) + kTwiceCentre * (cos + sin), cos, sin};
}

}  // namespace iog::placing
