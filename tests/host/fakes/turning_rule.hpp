// Level lidars that turn (docs/model.md section 5), worked out from metres and degrees: the
// azimuth's step, the one line of all layers, what a range is along it, and each cell by exact
// shares of the line. Nothing of a compiled sensor is used but its profile.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>
#include <span>
#include <utility>

#include "fakes/random.hpp"
#include "geometry/grid.hpp"
#include "lab/reference/exact_line.hpp"
#include "lidar/scan_point.hpp"
#include "numeric/division.hpp"
#include "sensor_model/profile.hpp"
#include "tools/car/description.hpp"
#include "vehicle/beam.hpp"

namespace iog::tests {

inline constexpr std::int64_t kTicksOfVlp16 = 36'000;

inline long double radians(double degrees) {
  return static_cast<long double>(degrees) * std::numbers::pi_v<long double> / 180;
}

// Rounded to the nearest whole number, or nothing where rounding on the way could show: the
// firmware's ends are within 0.002 subcells of the real ones.
inline std::optional<std::int32_t> clearly(long double subcells) {
  const long double below = std::floor(subcells);
  if (std::abs(subcells - below - 0.5L) < 0.003L) {
    return std::nullopt;
  }
  return static_cast<std::int32_t>(std::llround(subcells));
}

// The largest fraction of a turn in powers of two whose half, L away, is half a cell or less.
inline std::int64_t steps_for(std::int64_t range_mm, double cell_m) {
  std::int64_t steps = 1;
  while (2 * std::numbers::pi_v<long double> / static_cast<long double>(steps) *
             static_cast<long double>(range_mm) / 2 >
         static_cast<long double>(cell_m) * 1000 / 2) {
    steps *= 2;
  }
  return steps;
}

// Where one beam runs, by the rule.
struct TurningRay {
  geometry::SubcellPoint start;
  geometry::SubcellPoint end;
  std::int64_t z_start = 0;
  std::int64_t z_end = 0;
};

class TurningRule {
 public:
  // lines_are_beams: of a tilted lidar, whose lines are as long as its beams seen from above.
  TurningRule(const description::SensorConfig& config, const description::Description& description,
              std::span<const double> elevations_deg, bool lines_are_beams = false)
      : config_(config),
        description_(description),
        elevations_deg_(elevations_deg),
        lines_are_beams_(lines_are_beams) {}

  [[nodiscard]] std::optional<TurningRay> ray(const lidar::ScanPoint& point) const {
    const std::int64_t steps = steps_for(config_.range_max_mm, description_.grid.cell_m);
    const std::int64_t step =
        (2 * point.azimuth_ticks * steps + kTicksOfVlp16) / (2 * kTicksOfVlp16) % steps;
    const long double azimuth = 2 * std::numbers::pi_v<long double> *
                                    static_cast<long double>(step) /
                                    static_cast<long double>(steps) +
                                radians(config_.mount.yaw_deg);
    const long double length_m = config_.range_max_mm / 1000.0L;
    const description::GridConfig& grid = description_.grid;
    const auto exact = [&](double mount_m, double corner_m, long double way_m) {
      return (static_cast<long double>(mount_m) + static_cast<long double>(corner_m) + way_m) *
             scale();
    };
    const auto x = clearly(exact(config_.mount.x_m, grid.behind_m, length_m * std::cos(azimuth)));
    const auto y = clearly(exact(config_.mount.y_m, grid.right_m, length_m * std::sin(azimuth)));
    const long double elevation = radians(elevations_deg_[point.layer]);
    const auto z = clearly(
        (static_cast<long double>(config_.mount.z_m) + length_m * std::tan(elevation)) * scale());
    if (!x || !y || !z) {
      return std::nullopt;
    }
    return TurningRay{.start = {static_cast<std::int32_t>(
                                    std::llround(exact(config_.mount.x_m, grid.behind_m, 0))),
                                static_cast<std::int32_t>(
                                    std::llround(exact(config_.mount.y_m, grid.right_m, 0)))},
                      .end = {*x, *y},
                      .z_start = subcells(config_.mount.z_m),
                      .z_end = *z};
  }

  [[nodiscard]] std::int64_t along(const lidar::ScanPoint& point, std::int64_t range_mm) const {
    if (lines_are_beams_) {
      return range_mm;
    }
    const long double cosine = std::cos(radians(elevations_deg_[point.layer]));
    return range_mm * std::llround(cosine * (1 << 30)) / (1 << 30);
  }

  [[nodiscard]] vehicle::Fate fate(const TurningRay& ray, const lidar::ScanPoint& point) const {
    if (point.range_mm == 0) {
      return vehicle::Fate::kNoReturn;
    }
    const std::int64_t measured = point.range_mm;  // by which too near is judged
    const std::int64_t at = along(point, measured);
    const description::FootprintConfig& car = description_.footprint;
    const description::GridConfig& grid = description_.grid;
    const bool is_on_car = is_between(ray.start.x, ray.end.x, measured, car.x_min_m + grid.behind_m,
                                      car.x_max_m + grid.behind_m) &&
                           is_between(ray.start.y, ray.end.y, measured, car.y_min_m + grid.right_m,
                                      car.y_max_m + grid.right_m);
    if (point.range_mm < config_.range_min_mm || is_on_car) {
      return vehicle::Fate::kTooNear;
    }
    if (at > length()) {
      return vehicle::Fate::kTooFar;
    }
    const bool is_in_band =
        is_between(ray.z_start, ray.z_end, at, description_.z_min_m, description_.z_max_m);
    return is_in_band ? vehicle::Fate::kUsed : vehicle::Fate::kOutsideHeightBand;
  }

  // What the point alone makes of a cell, given its fate. counts_to_mm: so far along its line the
  // beam counts; none: in the height band.
  [[nodiscard]] int index(const sensor_model::Profile& profile, const TurningRay& ray,
                          const lidar::ScanPoint& point, vehicle::Fate fate, geometry::Cell cell,
                          std::optional<std::int64_t> counts_to_mm = {}) const {
    const bool is_missing = fate == vehicle::Fate::kNoReturn;
    const std::int64_t at = along(point, is_missing ? config_.no_return_clears_mm : point.range_mm);
    const bool ends = !is_missing && fate != vehicle::Fate::kTooFar;
    if (fate == vehicle::Fate::kTooNear || (is_missing && at == 0)) {
      return 0;
    }
    auto crossing = lab::reference::cross(ray.start, ray.end, cell, geometry::kResolution);
    const geometry::Cell first{numeric::div_floor(ray.start.x, geometry::kResolution),
                               numeric::div_floor(ray.start.y, geometry::kResolution)};
    if (!crossing && cell == first) {
      // It contains the start, even if the line only touches it at a corner.
      crossing = {.enter = {0, 1}, .leave = {1, 1'000'000}};
    }
    if (ends && cell == cell_at(ray, at)) {
      return fate == vehicle::Fate::kUsed ? profile.hit : 0;
    }
    const lab::reference::Rational reach{std::min(at, length()), length()};
    if (!crossing || !(counts_to_mm ? is_carved(*crossing, reach, {*counts_to_mm, length()})
                                    : is_carved(ray, *crossing, reach))) {
      return 0;
    }
    const std::int64_t k = at / config_.precision_mm;
    if (is_missing) {
      return profile.free;
    }
    if (ends && lab::reference::Rational{at, length()} < crossing->leave) {
      return 0;  // behind the scan point the profile of the blurring policy says nothing
    }
    const std::int64_t left_in = cells_up_to(crossing->leave);
    return profile.at(static_cast<int>(std::min(left_in, k - 1) - k));
  }

 private:
  [[nodiscard]] std::int64_t length() const { return config_.range_max_mm; }
  // Subcells of a metre.
  [[nodiscard]] long double scale() const {
    return geometry::kResolution / static_cast<long double>(description_.grid.cell_m);
  }
  [[nodiscard]] std::int64_t subcells(double metres) const {
    return std::llround(static_cast<long double>(metres) * scale());
  }

  // Whether what is at distance `at` of L between the two ends is within the limits.
  [[nodiscard]] bool is_between(std::int64_t start, std::int64_t end, std::int64_t at, double low_m,
                                double high_m) const {
    const std::int64_t place = start * length() + (end - start) * at;
    return subcells(low_m) * length() <= place && place <= subcells(high_m) * length();
  }

  // The cell that holds the scan point; on a border the later one.
  [[nodiscard]] geometry::Cell cell_at(const TurningRay& ray, std::int64_t at) const {
    const auto on_axis = [&](std::int64_t start, std::int64_t end) {
      const std::int64_t place = start * length() + (end - start) * at;
      const std::int64_t side = geometry::kResolution * length();
      return static_cast<std::int32_t>(end < start ? -numeric::div_floor(-place, side) - 1
                                                   : numeric::div_floor(place, side));
    };
    return {on_axis(ray.start.x, ray.end.x), on_axis(ray.start.y, ray.end.y)};
  }

  // Whether the line is in the cell's interior before `reach`, and in the cell before it leaves
  // what counts.
  [[nodiscard]] static bool is_carved(const lab::reference::Crossing& crossing,
                                      lab::reference::Rational reach,
                                      lab::reference::Rational leaves) {
    const lab::reference::Rational zero{0, 1};
    return zero < leaves && !(leaves < crossing.enter) && crossing.enter < reach &&
           zero < crossing.leave;
  }

  // Whether the line is in the cell's interior before `reach` and inside the height band.
  [[nodiscard]] bool is_carved(const TurningRay& ray, const lab::reference::Crossing& crossing,
                               lab::reference::Rational reach) const {
    const lab::reference::Rational zero{0, 1};
    lab::reference::Rational from = zero;
    lab::reference::Rational to = reach;
    const std::int64_t rise = ray.z_end - ray.z_start;
    const std::int64_t low = subcells(description_.z_min_m) - ray.z_start;
    const std::int64_t high = subcells(description_.z_max_m) - ray.z_start;
    if (rise == 0 && (low > 0 || high < 0)) {
      return false;
    }
    if (rise != 0) {
      const lab::reference::Rational enters =
          rise > 0 ? lab::reference::Rational{low, rise} : lab::reference::Rational{-high, -rise};
      const lab::reference::Rational leaves =
          rise > 0 ? lab::reference::Rational{high, rise} : lab::reference::Rational{-low, -rise};
      from = from < enters ? enters : from;
      to = leaves < to ? leaves : to;
    }
    return from < to && crossing.enter < to && from < crossing.leave && zero < crossing.leave;
  }

  // ceil(share L / Delta) - 1: the 1D cell in which the line still is when it leaves a cell.
  [[nodiscard]] std::int64_t cells_up_to(lab::reference::Rational share) const {
    const std::int64_t n = share.numerator * length();
    return -numeric::div_floor(-n, share.denominator * config_.precision_mm) - 1;
  }

  const description::SensorConfig& config_;
  const description::Description& description_;
  std::span<const double> elevations_deg_;
  bool lines_are_beams_;
};

// The cells that the line might touch: of each row those that it runs through in this row, the one
// before and the one behind, and one more at either end. The line is at most a rectangle's
// diagonal, so most of its rectangle is left out; whoever looks for cells that should not be known
// counts all of the grid.
template <typename Visit>
void for_each_cell_around(const TurningRay& ray, Visit&& visit,
                          const geometry::CellArea& area = geometry::kGridArea) {
  const auto cells = [](std::int32_t a, std::int32_t b) {
    return std::pair{numeric::div_floor(std::min(a, b), geometry::kResolution) - 1,
                     numeric::div_floor(std::max(a, b), geometry::kResolution) + 1};
  };
  // Between 0 and 1, where the line is in that row.
  const auto share = [&](std::int32_t row) {
    const std::int64_t rise = std::int64_t{ray.end.y} - ray.start.y;
    const std::int64_t up = std::int64_t{row} * geometry::kResolution - ray.start.y;
    return std::clamp(static_cast<double>(up) / static_cast<double>(rise), 0.0, 1.0);
  };
  const auto x_at = [&](double its_share) {
    return static_cast<std::int32_t>(ray.start.x + its_share * (ray.end.x - ray.start.x));
  };
  const auto [y_first, y_last] = cells(ray.start.y, ray.end.y);
  for (std::int32_t y = y_first; y <= y_last; ++y) {
    const bool is_level = ray.start.y == ray.end.y;
    const auto [x_first, x_last] =
        is_level ? cells(ray.start.x, ray.end.x) : cells(x_at(share(y - 1)), x_at(share(y + 2)));
    for (std::int32_t x = x_first; x <= x_last; ++x) {
      if (area.contains({x, y})) {
        visit(geometry::Cell{x, y});
      }
    }
  }
}

inline lidar::ScanPoint random_point(Random& random, std::size_t layers, int longest_mm) {
  return {
      .range_mm = static_cast<std::uint32_t>(random.one_in(12)  ? 0
                                             : random.one_in(4) ? random.between(500, 4'000)
                                                                : random.between(1, longest_mm)),
      .azimuth_ticks = static_cast<std::uint16_t>(random.one_in(6) ? random.between(0, 7) * 4500
                                                                   : random.between(0, 35'999)),
      .layer = static_cast<std::uint8_t>(random.below(layers))};
}

}  // namespace iog::tests
