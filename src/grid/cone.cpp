// Ranges: a line of 10 m is below 2^18 subcells of the finest grid, and no tested corner is
// farther, so products are below 2^36.
#include "grid/cone.hpp"

#include <algorithm>
#include <utility>

#include "numeric/division.hpp"
#include "numeric/square_root.hpp"
#include "vehicle/beam.hpp"

namespace iog::grid {
namespace {

// A vector from the unit, in subcells.
struct Vector {
  std::int64_t x = 0;
  std::int64_t y = 0;

  [[nodiscard]] constexpr std::int64_t square() const { return x * x + y * y; }
};

std::int64_t extent_of(const traversal::Axis<geometry::kResolution>& axis) {
  return std::int64_t{axis.step()} * axis.length();
}

// The end of the unit's range at this angle to the left of the echo.
Vector end_of(const vehicle::Sensor& sensor, const lidar::ScanPoint& echo, std::int32_t off_ticks) {
  const auto turn = static_cast<std::int32_t>(sensor.azimuths.ticks_per_turn());
  const auto azimuth = static_cast<std::uint32_t>((echo.azimuth_ticks + off_ticks + turn) % turn);
  const vehicle::BeamLine line =
      vehicle::line_of(sensor, sensor.layers[echo.layer], vehicle::direction_of(sensor, azimuth));
  return {extent_of(line.x()), extent_of(line.y())};
}

// The bounds of a cell along one axis.
struct Side {
  std::int64_t low = 0;

  [[nodiscard]] constexpr std::int64_t high() const { return low + geometry::kResolution; }
  // The bound whose product with the factor is smaller.
  [[nodiscard]] constexpr std::int64_t least_by(std::int64_t factor) const {
    return factor < 0 ? high() : low;
  }
  [[nodiscard]] constexpr std::int64_t farthest() const { return std::max(-low, high()); }
};

// Whether the whole cell lies to the left of a direction.
constexpr bool is_left_of(const Vector& direction, Side x, Side y) {
  return direction.x * y.least_by(direction.x) - direction.y * x.least_by(-direction.y) >= 0;
}

struct Cone {
  Vector right;
  Vector left;
  std::int64_t length = 0;  // in subcells

  [[nodiscard]] constexpr bool contains(Side x, Side y) const {
    return is_left_of(right, x, y) && is_left_of({-left.x, -left.y}, x, y) &&
           Vector{x.farthest(), y.farthest()}.square() <= length * length;
  }
};

// A range of cells along an axis, both ends included. A cone that opens by less than half a turn
// stays on one side of the unit if both of its borders do.
struct Span {
  std::int32_t first = 0;
  std::int32_t last = 0;
};

Span span_of(std::int32_t origin, std::int64_t right, std::int64_t left, std::int64_t length,
             std::int32_t cells) {
  const std::int64_t back = right >= 0 && left >= 0 ? 0 : length;
  const std::int64_t ahead = right <= 0 && left <= 0 ? 0 : length;
  const auto cell = [&](std::int64_t at) {
    return static_cast<std::int32_t>(std::clamp<std::int64_t>(
        numeric::div_floor(at, std::int64_t{geometry::kResolution}), 0, cells - 1));
  };
  return {cell(origin - back), cell(origin + ahead)};
}

Cone cone_of(const vehicle::Sensor& sensor, const lidar::ScanPoint& echo) {
  const std::int32_t reach = sensor.arc.reach_ticks();
  const Vector middle = end_of(sensor, echo, 0);
  Cone cone{.right = end_of(sensor, echo, -reach), .left = end_of(sensor, echo, reach)};
  if (cone.right.x * cone.left.y < cone.right.y * cone.left.x) {
    std::swap(cone.right, cone.left);  // the unit is mounted upside down
  }
  const std::uint32_t near = sensor.profile.near_before_count;
  const std::uint32_t k = sensor.precision.divide(echo.range_mm);
  const std::int64_t free_mm = std::int64_t{k > near ? k - near : 0} * sensor.precision_mm;
  const std::int64_t shortest =
      std::min({middle.square(), cone.right.square(), cone.left.square()});
  cone.length = std::int64_t{numeric::square_root(static_cast<std::uint64_t>(shortest))} * free_mm /
                sensor.range.mm();
  return cone;
}

}  // namespace

void carve_cone(BlockGrid& grid, const vehicle::Sensor& sensor, const lidar::ScanPoint& echo) {
  const Cone cone = cone_of(sensor, echo);
  const geometry::CellArea area = sensor.grid.area();
  const Span columns = span_of(sensor.origin.x, cone.right.x, cone.left.x, cone.length, area.width);
  const Span rows = span_of(sensor.origin.y, cone.right.y, cone.left.y, cone.length, area.height);
  for (std::int32_t row = rows.first; row <= rows.last; ++row) {
    const Side y{std::int64_t{row} * geometry::kResolution - sensor.origin.y};
    for (std::int32_t column = columns.first; column <= columns.last; ++column) {
      const Side x{std::int64_t{column} * geometry::kResolution - sensor.origin.x};
      if (cone.contains(x, y)) {
        const geometry::Cell cell{column, row};
        OccupancyIndex& index = grid.cell_at(offset_of(cell, grid.stride()));
        index = index::sat_lower(index, sensor.arc.free);
        grid.touch(geometry::tile_of(cell, grid.tiles_across()));
      }
    }
  }
}

}  // namespace iog::grid
