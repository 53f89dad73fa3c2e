// Level lidars that turn (docs/model.md section 5), against the rule worked out here from metres
// and degrees: the azimuth's step, the one line of all layers, what a range is along it, and each
// cell by exact shares of the line. Nothing of a compiled sensor is used but its profile.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <gtest/gtest.h>
#include <memory>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "fakes/cells_of.hpp"
#include "fakes/effort.hpp"
#include "fakes/random.hpp"
#include "fakes/test_vehicles.hpp"
#include "grid/frame_fusion.hpp"
#include "lab/reference/exact_line.hpp"

namespace iog::grid {
namespace {

using geometry::Cell;
using geometry::kCellMm;
using geometry::kResolution;
using geometry::SubcellPoint;
using lab::reference::Rational;
using tests::LevelVlp16;
using tests::ManyLayers;
using tests::SteepVlp16;
using vehicle::Fate;

constexpr std::int64_t kTicks = 36'000;

long double radians(double degrees) {
  return static_cast<long double>(degrees) * std::numbers::pi_v<long double> / 180;
}

std::int64_t subcells(double metres) {
  return std::llround(static_cast<long double>(metres) * 1000 / kCellMm * kResolution);
}

// Rounded to the nearest whole number, or nothing where rounding on the way could show: the
// firmware's ends are within 0.002 subcells of the real ones.
std::optional<std::int32_t> clearly(long double subcells) {
  const long double below = std::floor(subcells);
  if (std::abs(subcells - below - 0.5L) < 0.003L) {
    return std::nullopt;
  }
  return static_cast<std::int32_t>(std::llround(subcells));
}

// The largest fraction of a turn in powers of two whose half, L away, is half a cell or less.
std::int64_t steps_for(std::int64_t range_mm) {
  std::int64_t steps = 1;
  while (2 * std::numbers::pi_v<long double> / static_cast<long double>(steps) *
             static_cast<long double>(range_mm) / 2 >
         kCellMm / 2.0L) {
    steps *= 2;
  }
  return steps;
}

// Where one beam runs, by the rule.
struct Ray {
  SubcellPoint start;
  SubcellPoint end;
  std::int64_t z_start = 0;
  std::int64_t z_end = 0;
};

class Rule {
 public:
  Rule(const description::SensorConfig& config, const description::Description& description,
       std::span<const double> elevations_deg)
      : config_(config), description_(description), elevations_deg_(elevations_deg) {}

  [[nodiscard]] std::optional<Ray> ray(const lidar::ScanPoint& point) const {
    const std::int64_t steps = steps_for(config_.range_max_mm);
    const std::int64_t step = (2 * point.azimuth_ticks * steps + kTicks) / (2 * kTicks) % steps;
    const long double azimuth = 2 * std::numbers::pi_v<long double> *
                                    static_cast<long double>(step) /
                                    static_cast<long double>(steps) +
                                radians(config_.mount.yaw_deg);
    const long double length_m = config_.range_max_mm / 1000.0L;
    const long double middle_m = geometry::kOriginCell * kCellMm / 1000.0L;
    const auto exact = [&](double mount_m, long double way_m) {
      return (static_cast<long double>(mount_m) + middle_m + way_m) * 1000 / kCellMm * kResolution;
    };
    const auto x = clearly(exact(config_.mount.x_m, length_m * std::cos(azimuth)));
    const auto y = clearly(exact(config_.mount.y_m, length_m * std::sin(azimuth)));
    const long double elevation = radians(elevations_deg_[point.layer]);
    const auto z =
        clearly((static_cast<long double>(config_.mount.z_m) + length_m * std::tan(elevation)) *
                1000 / kCellMm * kResolution);
    if (!x || !y || !z) {
      return std::nullopt;
    }
    return Ray{.start = {static_cast<std::int32_t>(std::llround(exact(config_.mount.x_m, 0))),
                         static_cast<std::int32_t>(std::llround(exact(config_.mount.y_m, 0)))},
               .end = {*x, *y},
               .z_start = subcells(config_.mount.z_m),
               .z_end = *z};
  }

  [[nodiscard]] std::int64_t along(const lidar::ScanPoint& point, std::int64_t range_mm) const {
    const long double cosine = std::cos(radians(elevations_deg_[point.layer]));
    return range_mm * std::llround(cosine * (1 << 30)) / (1 << 30);
  }

  [[nodiscard]] Fate fate(const Ray& ray, const lidar::ScanPoint& point) const {
    if (point.range_mm == 0) {
      return Fate::kNoReturn;
    }
    const std::int64_t measured = point.range_mm;  // by which too near is judged
    const std::int64_t at = along(point, measured);
    const description::FootprintConfig& car = description_.footprint;
    const bool is_on_car = is_between(ray.start.x, ray.end.x, measured, car.x_min_m + middle(),
                                      car.x_max_m + middle()) &&
                           is_between(ray.start.y, ray.end.y, measured, car.y_min_m + middle(),
                                      car.y_max_m + middle());
    if (point.range_mm < config_.range_min_mm || is_on_car) {
      return Fate::kTooNear;
    }
    if (at > length()) {
      return Fate::kTooFar;
    }
    const bool is_in_band =
        is_between(ray.z_start, ray.z_end, at, description_.z_min_m, description_.z_max_m);
    return is_in_band ? Fate::kUsed : Fate::kOutsideHeightBand;
  }

  // What the point alone makes of a cell, given its fate.
  [[nodiscard]] int index(const sensor_model::Profile& profile, const Ray& ray,
                          const lidar::ScanPoint& point, Fate fate, Cell cell) const {
    const bool is_missing = fate == Fate::kNoReturn;
    const std::int64_t at = along(point, is_missing ? config_.no_return_clears_mm : point.range_mm);
    const bool ends = !is_missing && fate != Fate::kTooFar;
    if (fate == Fate::kTooNear || (is_missing && at == 0)) {
      return 0;
    }
    const auto crossing = lab::reference::cross(ray.start, ray.end, cell, kResolution);
    if (ends && cell == cell_at(ray, at)) {
      return fate == Fate::kUsed ? profile.hit : 0;
    }
    if (!crossing || !is_carved(ray, *crossing, {std::min(at, length()), length()})) {
      return 0;
    }
    const std::int64_t k = at / config_.precision_mm;
    if (is_missing) {
      return profile.free;
    }
    if (ends && Rational{at, length()} < crossing->leave) {
      return 0;  // behind the scan point the profile of the blurring policy says nothing
    }
    const std::int64_t left_in = cells_up_to(crossing->leave);
    return profile.at(static_cast<int>(std::min(left_in, k - 1) - k));
  }

 private:
  [[nodiscard]] std::int64_t length() const { return config_.range_max_mm; }
  static double middle() { return geometry::kOriginCell * kCellMm / 1000.0; }

  // Whether what is at distance `at` of L between the two ends is within the limits.
  [[nodiscard]] bool is_between(std::int64_t start, std::int64_t end, std::int64_t at, double low_m,
                                double high_m) const {
    const std::int64_t place = start * length() + (end - start) * at;
    return subcells(low_m) * length() <= place && place <= subcells(high_m) * length();
  }

  // The cell that holds the scan point; on a border the later one.
  [[nodiscard]] Cell cell_at(const Ray& ray, std::int64_t at) const {
    const auto on_axis = [&](std::int64_t start, std::int64_t end) {
      const std::int64_t place = start * length() + (end - start) * at;
      const std::int64_t side = kResolution * length();
      return static_cast<std::int32_t>(end < start ? -numeric::div_floor(-place, side) - 1
                                                   : numeric::div_floor(place, side));
    };
    return {on_axis(ray.start.x, ray.end.x), on_axis(ray.start.y, ray.end.y)};
  }

  // Whether the line is in the cell's interior before `reach` and inside the height band.
  [[nodiscard]] bool is_carved(const Ray& ray, const lab::reference::Crossing& crossing,
                               Rational reach) const {
    const Rational zero{0, 1};
    Rational from = zero;
    Rational to = reach;
    const std::int64_t rise = ray.z_end - ray.z_start;
    const std::int64_t low = subcells(description_.z_min_m) - ray.z_start;
    const std::int64_t high = subcells(description_.z_max_m) - ray.z_start;
    if (rise == 0 && (low > 0 || high < 0)) {
      return false;
    }
    if (rise != 0) {
      const Rational enters = rise > 0 ? Rational{low, rise} : Rational{-high, -rise};
      const Rational leaves = rise > 0 ? Rational{high, rise} : Rational{-low, -rise};
      from = from < enters ? enters : from;
      to = leaves < to ? leaves : to;
    }
    return from < to && crossing.enter < to && from < crossing.leave && zero < crossing.leave;
  }

  // ceil(share L / Delta) - 1: the 1D cell in which the line still is when it leaves a cell.
  [[nodiscard]] std::int64_t cells_up_to(Rational share) const {
    const std::int64_t n = share.numerator * length();
    return -numeric::div_floor(-n, share.denominator * config_.precision_mm) - 1;
  }

  const description::SensorConfig& config_;
  const description::Description& description_;
  std::span<const double> elevations_deg_;
};

template <typename Visit>
void for_each_cell_around(const Ray& ray, Visit&& visit) {
  const auto cells = [](std::int32_t a, std::int32_t b) {
    return std::pair{numeric::div_floor(std::min(a, b), kResolution) - 1,
                     numeric::div_floor(std::max(a, b), kResolution) + 1};
  };
  const auto [x_first, x_last] = cells(ray.start.x, ray.end.x);
  const auto [y_first, y_last] = cells(ray.start.y, ray.end.y);
  for (std::int32_t y = y_first; y <= y_last; ++y) {
    for (std::int32_t x = x_first; x <= x_last; ++x) {
      if (geometry::kGridArea.contains({x, y})) {
        visit(Cell{x, y});
      }
    }
  }
}

lidar::ScanPoint random_point(tests::Random& random, std::size_t layers, int longest_mm) {
  return {
      .range_mm = static_cast<std::uint32_t>(random.one_in(12)  ? 0
                                             : random.one_in(4) ? random.between(500, 4'000)
                                                                : random.between(1, longest_mm)),
      .azimuth_ticks = static_cast<std::uint16_t>(random.one_in(6) ? random.between(0, 7) * 4500
                                                                   : random.between(0, 35'999)),
      .layer = static_cast<std::uint8_t>(random.below(layers))};
}

// One point after the other, each in a frame of its own.
template <typename Car>
class AlonePoints {
 public:
  explicit AlonePoints(std::span<const double> elevations_deg)
      : rule_(Car::kConfigs[0], Car::kDescription, elevations_deg) {}

  // All cells of the rectangle around the line, a border of one included, and no others.
  void expect_as_the_rule_says(const lidar::ScanPoint& point) {
    const std::optional<Ray> ray = rule_.ray(point);
    if (!ray) {
      return;
    }
    const vehicle::Sensor& sensor = Car::kVehicle.sensors[0];
    const Fate fate = fusion_->add(sensor, point);
    fusion_->finish();
    ASSERT_EQ(fate, rule_.fate(*ray, point)) << words_of(point);
    ++fates_[static_cast<std::size_t>(fate)];
    std::ptrdiff_t known = 0;
    for_each_cell_around(*ray, [&](Cell cell) {
      const int found = fusion_->view().at(cell);
      known += found != 0 ? 1 : 0;
      ASSERT_EQ(found, rule_.index(sensor.profile, *ray, point, fate, cell))
          << "cell " << cell.x << ", " << cell.y << ", " << words_of(point);
    });
    const auto cells = tests::cells_of(*fusion_);
    ASSERT_EQ(std::ssize(cells) - std::ranges::count(cells, 0), known);
    fusion_->clear();
  }

  [[nodiscard]] int count(Fate fate) const { return fates_[static_cast<std::size_t>(fate)]; }

 private:
  static std::string words_of(const lidar::ScanPoint& point) {
    return "range " + std::to_string(point.range_mm) + ", tick " +
           std::to_string(point.azimuth_ticks) + ", layer " + std::to_string(point.layer);
  }

  Rule rule_;
  std::unique_ptr<FrameFusion> fusion_ = std::make_unique<FrameFusion>(Car::kVehicle);
  std::array<int, vehicle::kFateCount> fates_{};
};

template <typename Car>
void expect_every_cell_as_the_rule_says(std::span<const double> elevations_deg, std::uint64_t seed,
                                        int points) {
  AlonePoints<Car> alone(elevations_deg);
  tests::Random random(seed);
  const int longest_mm = static_cast<int>(Car::kConfigs[0].range_max_mm) * 9 / 8;
  for (int i = 0; i < points && !testing::Test::HasFatalFailure(); ++i) {
    alone.expect_as_the_rule_says(random_point(random, elevations_deg.size(), longest_mm));
  }
  EXPECT_GT(alone.count(Fate::kUsed), 0);
  EXPECT_GT(alone.count(Fate::kOutsideHeightBand), 0);
}

TEST(Turning, EveryCellIsAsTheRuleSaysForAVlp16) {
  expect_every_cell_as_the_rule_says<LevelVlp16>(lidar::VelodyneVlp16::kElevationsDeg, 51,
                                                 tests::effort(120, 8));
}
TEST(Turning, EveryCellIsAsTheRuleSaysFor128Layers) {
  expect_every_cell_as_the_rule_says<ManyLayers>(ManyLayers::kElevationsDeg, 52,
                                                 tests::effort(120, 8));
}

TEST(Turning, EveryCellIsAsTheRuleSaysAtTheLimits) {
  expect_every_cell_as_the_rule_says<SteepVlp16>(SteepVlp16::kElevationsDeg, 53,
                                                 tests::effort(60, 8));
}

// Where the car's own border lies is asked of what was measured, as the sensor's minimum is, and
// not of how far along the line that is: steep layers would show it.
TEST(Turning, TooNearIsJudgedByWhatIsMeasured) {
  const Rule rule(LevelVlp16::kConfigs[0], LevelVlp16::kDescription,
                  lidar::VelodyneVlp16::kElevationsDeg);
  const vehicle::Sensor& sensor = LevelVlp16::kVehicle.sensors[0];
  int on_border = 0;
  for (const std::uint16_t tick : std::to_array<std::uint16_t>({0, 4'507, 9'001, 18'000, 27'013})) {
    for (std::uint32_t range_mm = 1; range_mm < 6'000; ++range_mm) {
      const lidar::ScanPoint point{.range_mm = range_mm, .azimuth_ticks = tick, .layer = 0};
      const vehicle::Beam beam = vehicle::aim(sensor, point.layer, point.azimuth_ticks);
      const Fate fate = vehicle::classify(sensor, beam, point).fate;
      const std::optional<Ray> ray = rule.ray(point);
      ASSERT_TRUE(ray);
      ASSERT_EQ(fate, rule.fate(*ray, point)) << tick << ", " << range_mm;
      on_border += fate == Fate::kTooNear && range_mm >= sensor.range_min_mm ? 1 : 0;
    }
  }
  EXPECT_GT(on_border, 0);
}

// Where a point comes to lie behind the end of the band, the zones before it leave the band one
// after the other, until all of the part inside is free.
TEST(Turning, EveryCellIsAsTheRuleSaysBehindTheBand) {
  constexpr int kStepMm = tests::effort(41, 163);
  tests::Random random(54);
  AlonePoints<LevelVlp16> alone(lidar::VelodyneVlp16::kElevationsDeg);
  const auto sensor_m = static_cast<long double>(LevelVlp16::kConfigs[0].mount.z_m);
  // Steps of 5 have layers above and below by turns.
  constexpr std::size_t kLayerStep = tests::effort(1, 5);
  for (std::size_t layer = 0; layer < lidar::VelodyneVlp16::kElevationsDeg.size();
       layer += kLayerStep) {
    const long double elevation = radians(lidar::VelodyneVlp16::kElevationsDeg[layer]);
    const description::Description& car = LevelVlp16::kDescription;
    const auto limit_m = static_cast<long double>(elevation < 0 ? car.z_min_m : car.z_max_m);
    const auto end_mm = static_cast<int>(1000 * (limit_m - sensor_m) / std::sin(elevation));
    for (int range_mm = end_mm - 50; range_mm < end_mm + 600 && !HasFatalFailure();
         range_mm += kStepMm) {
      alone.expect_as_the_rule_says(
          {.range_mm = static_cast<std::uint32_t>(range_mm),
           .azimuth_ticks = static_cast<std::uint16_t>(random.between(0, 35'999)),
           .layer = static_cast<std::uint8_t>(layer)});
    }
  }
  EXPECT_GT(alone.count(Fate::kOutsideHeightBand), 5);
}

// Beams of a line wait for one another, several azimuths at a time, and their lines are kept from
// frame to frame; what they carve is what each carves at once, on lines that a new fusion finds.
TEST(Turning, NeitherWaitingNorKeepingALineShows) {
  tests::Random random(53);
  for (const vehicle::Vehicle& car :
       {LevelVlp16::kVehicle, ManyLayers::kVehicle, tests::MixedCar::kVehicle}) {
    const auto waits = std::make_unique<FrameFusion>(car);
    for (int frame = 0; frame < 3; ++frame) {
      const auto alone = std::make_unique<FrameFusion>(car);
      for (int i = 0; i < tests::effort(2'000, 100); ++i) {
        // Close together, and the sensors by turns, each for a while.
        const vehicle::Sensor& sensor =
            car.sensors[static_cast<std::size_t>(i / 50) % car.sensors.size()];
        lidar::ScanPoint point = random_point(random, sensor.layer_count, 40'000);
        point.azimuth_ticks = static_cast<std::uint16_t>(random.below(100));
        point.echo = random.one_in(8) ? std::uint8_t{1} : std::uint8_t{0};
        const Fate fate = waits->add(sensor, point);
        ASSERT_EQ(alone->add(sensor, point), fate);
        alone->carve_waiting();
      }
      waits->finish();
      alone->finish();
      ASSERT_EQ(tests::cells_of(*waits), tests::cells_of(*alone)) << car.name;
      waits->clear();
    }
  }
}

}  // namespace
}  // namespace iog::grid
