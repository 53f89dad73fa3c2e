#include "lab/reference/many_core.hpp"

#include <algorithm>
#include <cmath>

#include "lab/reference/fusion.hpp"
#include "numeric/division.hpp"
#include "numeric/elementary.hpp"

namespace iog::lab::reference {
namespace {

constexpr double kUnknown = 0.5;
constexpr double kRadiansPerDegree = numeric::kPi / 180;

Direction towards(double angle_rad) { return {numeric::cos(angle_rad), numeric::sin(angle_rad)}; }

// Cells along one axis of the grid, in metres from where a beam starts.
class Ruler {
 public:
  Ruler(double edge_m, double cell_m, std::int32_t cells, double origin_m)
      : edge_m_(edge_m),
        cell_m_(cell_m),
        cells_(cells),
        origin_m_(origin_m),
        per_m_(1 / cell_m),
        half_before_((origin_m - edge_m) * per_m_ - 0.5) {}

  [[nodiscard]] std::int32_t cells() const { return cells_; }

  // As cell_by_cell() computes it, to the bit.
  [[nodiscard]] double centre_m(std::int32_t cell) const {
    return edge_m_ + (cell + 0.5) * cell_m_ - origin_m_;
  }

  // The first cell whose centre is not before this, and the one after the last whose centre is not
  // behind it; 0 ... cells. What is within rounding of a centre counts as on it.
  [[nodiscard]] std::int32_t first_from(double m) const {
    return limited(std::ceil(m * per_m_ + half_before_ - kRounding));
  }
  [[nodiscard]] std::int32_t end_at(double m) const {
    return limited(std::floor(m * per_m_ + half_before_ + kRounding) + 1);
  }

 private:
  static constexpr double kRounding = 1e-6;  // cells

  [[nodiscard]] std::int32_t limited(double cell) const {
    return static_cast<std::int32_t>(std::clamp(cell, 0.0, static_cast<double>(cells_)));
  }

  double edge_m_;
  double cell_m_;
  std::int32_t cells_;
  double origin_m_;
  double per_m_;
  double half_before_;  // cells from the first one's centre to the origin
};

// Follows one beam through the grid, along the axis it is nearer to: line after line of cells
// across that axis, and in each those whose centres the beam sees.
class BeamCast {
 public:
  BeamCast(const PlaneGrid& grid, const Fan& fan, std::size_t beam)
      : fan_(fan),
        beam_(beam),
        columns_(grid.x_min_m, grid.cell_m, grid.columns, fan.x_m()),
        rows_(grid.y_min_m, grid.cell_m, grid.rows, fan.y_m()) {
    const Direction ahead = fan.direction(beam);
    is_along_x_ = std::abs(ahead.x) >= std::abs(ahead.y);
    is_upwards_ = (is_along_x_ ? ahead.x : ahead.y) > 0;
    const double right = slope(fan.bisector(beam));
    const double left = slope(fan.bisector(beam + 1));
    low_ = is_upwards_ ? std::min(right, left) : std::max(right, left);
    high_ = is_upwards_ ? std::max(right, left) : std::min(right, left);
  }

  // Calls visit(cell, distance) for the cells whose centre is at most reach_m away. Returns how
  // many lines of cells were searched.
  template <typename Visit>
  std::uint64_t follow(double reach_m, Visit&& visit) const {
    const Ruler& along = is_along_x_ ? columns_ : rows_;
    const std::int32_t step = is_upwards_ ? 1 : -1;
    std::uint64_t searched = 0;
    for (std::int32_t line = is_upwards_ ? along.first_from(0) : along.end_at(0) - 1;
         line >= 0 && line < along.cells() && std::abs(along.centre_m(line)) <= reach_m;
         line += step) {
      ++searched;
      search(line, along.centre_m(line), reach_m, visit);
    }
    return searched;
  }

 private:
  // What lies between the borders of the field of view, within rounding. Which beam sees a centre
  // on a border is decided where cell_by_cell() decides it.
  template <typename Visit>
  void search(std::int32_t line, double along_m, double reach_m, Visit&& visit) const {
    const Ruler& across = is_along_x_ ? rows_ : columns_;
    const std::int32_t end = across.end_at(high_ * along_m);
    for (std::int32_t cell = across.first_from(low_ * along_m); cell < end; ++cell) {
      const double across_m = across.centre_m(cell);
      const double distance_m = std::sqrt(along_m * along_m + across_m * across_m);
      if (is_seen(along_m, across_m) && distance_m <= reach_m) {
        visit(is_along_x_ ? offset(line, cell) : offset(cell, line), distance_m);
      }
    }
  }

  // How far a border of the field of view moves across while it moves on by 1.
  [[nodiscard]] double slope(Direction border) const {
    return is_along_x_ ? border.y / border.x : border.x / border.y;
  }

  [[nodiscard]] bool is_seen(double along_m, double across_m) const {
    return is_along_x_ ? fan_.sees(beam_, along_m, across_m) : fan_.sees(beam_, across_m, along_m);
  }

  [[nodiscard]] std::size_t offset(std::int32_t column, std::int32_t row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_.cells()) +
           static_cast<std::size_t>(column);
  }

  const Fan& fan_;
  std::size_t beam_;
  Ruler columns_;
  Ruler rows_;
  bool is_along_x_ = true;
  bool is_upwards_ = true;
  double low_ = 0;  // slopes of the field of view's borders
  double high_ = 0;
};

}  // namespace

Fan::Fan(double x_m, double y_m, double middle_rad, double step_rad, std::size_t beams)
    : x_m_(x_m), y_m_(y_m), step_rad_(step_rad), beams_(beams), middle_(towards(middle_rad)) {
  const double half = static_cast<double>(beams) / 2;
  const double right_rad = middle_rad - half * step_rad;
  for (std::size_t i = 0; i <= beams; ++i) {
    const auto steps = static_cast<double>(i);
    bisectors_[i] = towards(right_rad + steps * step_rad);
    if (i < beams) {
      directions_[i] = towards(right_rad + (steps + 0.5) * step_rad);
    }
  }
}

// The arc tangent says which beam within its rounding; the borders themselves decide.
std::optional<std::size_t> Fan::beam_of(double dx_m, double dy_m) const {
  const double ahead_m = middle_.x * dx_m + middle_.y * dy_m;
  const double left_m = middle_.x * dy_m - middle_.y * dx_m;
  const auto last = static_cast<double>(beams_ - 1);
  const double place =
      std::floor(std::atan2(left_m, ahead_m) / step_rad_ + static_cast<double>(beams_) / 2);
  if (place < -1 || place > last + 1) {
    return std::nullopt;
  }
  auto beam = static_cast<std::size_t>(std::clamp(place, 0.0, last));
  if (beam > 0 && !is_left_of(bisectors_[beam], dx_m, dy_m)) {
    --beam;
  } else if (beam + 1 < beams_ && is_left_of(bisectors_[beam + 1], dx_m, dy_m)) {
    ++beam;
  }
  return sees(beam, dx_m, dy_m) ? std::optional(beam) : std::nullopt;
}

Operations cell_by_cell(const PlaneGrid& grid, std::span<const PlaneScan> scans,
                        const AnalyticModel& model, std::span<double> probabilities) {
  Operations operations;
  std::size_t cell = 0;
  for (std::int32_t row = 0; row < grid.rows; ++row) {
    for (std::int32_t column = 0; column < grid.columns; ++column) {
      double probability = kUnknown;
      for (const PlaneScan& scan : scans) {
        const double dx_m = grid.centre_x_m(column) - scan.fan->x_m();
        const double dy_m = grid.centre_y_m(row) - scan.fan->y_m();
        ++operations.searches;
        const std::optional<std::size_t> beam = scan.fan->beam_of(dx_m, dy_m);
        if (beam && scan.ranges_m[*beam] > 0) {
          const double distance_m = std::sqrt(dx_m * dx_m + dy_m * dy_m);
          const double said = model.probability(distance_m, scan.ranges_m[*beam]);
          probability = fuse_bayes(probability, said);
          ++operations.models;
          ++operations.fusions;
        }
      }
      probabilities[cell++] = probability;
      ++operations.accesses;
    }
  }
  return operations;
}

Operations beam_by_beam(const PlaneGrid& grid, std::span<const PlaneScan> scans,
                        const AnalyticModel& model, double stop_behind_m,
                        std::span<double> probabilities) {
  Operations operations;
  std::ranges::fill(probabilities, kUnknown);
  for (const PlaneScan& scan : scans) {
    for (std::size_t beam = 0; beam < scan.fan->beams(); ++beam) {
      const double range_m = scan.ranges_m[beam];
      if (range_m <= 0) {
        continue;
      }
      const BeamCast cast(grid, *scan.fan, beam);
      operations.searches +=
          cast.follow(range_m + stop_behind_m, [&](std::size_t cell, double distance_m) {
            const double said = model.probability(distance_m, range_m);
            probabilities[cell] = fuse_bayes(probabilities[cell], said);
            ++operations.models;
            ++operations.fusions;
            operations.accesses += 2;
          });
    }
  }
  return operations;
}

LuxScans::LuxScans(const description::MountConfig& mount, std::int32_t step_ticks)
    : step_ticks_(step_ticks),
      fan_(mount.x_m, mount.y_m, mount.yaw_deg * kRadiansPerDegree,
           step_ticks * 2 * numeric::kPi / lidar::IbeoLux::kTicksPerTurn,
           static_cast<std::size_t>(2 * kEdgeTicks / step_ticks + 1)) {}

void LuxScans::add(const lidar::ScanPoint& point) {
  constexpr std::int32_t kTurn = lidar::IbeoLux::kTicksPerTurn;
  const std::int32_t to_left =
      point.azimuth_ticks > kTurn / 2 ? point.azimuth_ticks - kTurn : point.azimuth_ticks;
  const std::int32_t beam = numeric::div_nearest(to_left + kEdgeTicks, step_ticks_);
  if (point.echo > 0 || point.is_dirt || point.is_rain || beam < 0 ||
      beam >= static_cast<std::int32_t>(fan_.beams())) {
    return;
  }
  const double elevation_rad = lidar::IbeoLux::kElevationsDeg[point.layer] * kRadiansPerDegree;
  ranges_m_[point.layer][static_cast<std::size_t>(beam)] =
      point.range_mm * 0.001 * numeric::cos(elevation_rad);
}

std::array<PlaneScan, LuxScans::kLayers> LuxScans::scans() const {
  std::array<PlaneScan, kLayers> scans;
  for (std::size_t layer = 0; layer < kLayers; ++layer) {
    scans[layer] = {.fan = &fan_, .ranges_m = std::span(ranges_m_[layer]).first(fan_.beams())};
  }
  return scans;
}

AnalyticModel lux_model() {
  constexpr double kReachM = 50;
  const auto share = [](double d_m) { return std::min(d_m / kReachM, 1.0); };
  return {.lambda = [share](double d_m) { return 0.9 - 0.2 * share(d_m); },
          .sigma_m = [](double) { return 0.10; },
          .free = [share](double d_m, double) { return 0.05 + 0.2 * share(d_m); }};
}

}  // namespace iog::lab::reference
