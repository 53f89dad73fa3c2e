#include "tools/car/limits.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "car_block/limits.hpp"
#include "lidar/scanner_facts.hpp"
#include "tools/car/tables.hpp"
#include "tools/car/tilted_mirror.hpp"
#include "vehicle/azimuth_steps.hpp"
#include "vehicle/derived.hpp"

namespace iog::description {
namespace {

using car_block::kFarthestM;
using vehicle::is_within;
using vehicle::Tell;

// Of the recursive set. Smaller ones have more indexes than a cell can hold.
constexpr double kLeastEpsilon = 0.01;
constexpr double kMostEpsilon = 0.4;

void check_span(double least, double most, std::string_view field, std::string_view allowed,
                const Tell& tell) {
  if (!is_within<double>(least, -kFarthestM, kFarthestM) || !(least <= most) ||
      !(most <= kFarthestM)) {
    tell({.field = field, .allowed = allowed});
  }
}

// The longest side of a grid of the largest cells.
constexpr double kLongestSideM =
    geometry::kLongestSide * std::ranges::max(geometry::kCellSizesMm) / 1000.0;
static_assert(kLongestSideM == 2048);  // as it is told

// car_block/limits.hpp checks the rectangle, which is given in cells.
void check_grid(const GridConfig& grid, const Tell& tell) {
  if (grid_of(grid).cell_mm == 0) {
    return;
  }
  const auto check = [&](double metres, std::string_view field) {
    if (!is_within<double>(metres, 0, kLongestSideM) || !is_whole(metres / grid.cell_m)) {
      tell({.field = field, .allowed = "0 ... 2048, a whole number of cells"});
    }
  };
  check(grid.ahead_m, "grid.ahead_m");
  check(grid.behind_m, "grid.behind_m");
  check(grid.left_m, "grid.left_m");
  check(grid.right_m, "grid.right_m");
}

// An assignment, or weighing by scan, has its own masses, which would replace those of the car
// file.
void check_evidence(const Description& car, const Tell& tell) {
  const EvidenceConfig& evidence = car.evidence;
  const auto check = [&](double value, double least, double most, std::string_view field,
                         std::string_view allowed) {
    if (!is_within(value, least, most)) {
      tell({.field = field, .allowed = allowed});
    }
  };
  check(evidence.slowest_m_s, 0.1, 10, "window.slowest_m_s", "0.1 ... 10");
  check(evidence.object_m / evidence.slowest_m_s, 0.1, 60, "window.object_m",
        car_block::kAccumulationWords);
  check(evidence.gap_m, 0.01 * evidence.slowest_m_s, evidence.object_m, "window.gap_m",
        "at most object_m, passed in 0.01 s or more");
  check(evidence.scans_per_second, 1, 100, "window.scans_per_second", "1 ... 100");
  check(evidence.free_mass, 0.05, 0.99, "window.free_mass", car_block::kMassWords);
  check(evidence.hit_mass, 0.05, 0.99, "window.hit_mass", car_block::kMassWords);
  check(evidence.moving_half_life_s, 0.05, 600, "window.moving_half_life_s",
        car_block::kHalfLifeWords);
  check(evidence.static_half_life_s, 0.05, 600, "window.static_half_life_s",
        car_block::kHalfLifeWords);
  const bool by_scan = car.window.weighing == ageing::Weighing::kEachScan;
  if (evidence != EvidenceConfig{} && (by_scan || car.window.assignment != nullptr)) {
    tell({.field = by_scan ? "window.weighing" : "window.assignment",
          .allowed = by_scan ? "by_time, because the file has constants of its own"
                             : "one_mass, because the file has constants of its own"});
  }
}

void check_car(const Description& car, const Tell& tell) {
  check_grid(car.grid, tell);
  check_evidence(car, tell);
  const FootprintConfig& footprint = car.footprint;
  if (!is_within<double>(car.z_min_m, -kFarthestM, kFarthestM) || !(car.z_min_m < car.z_max_m)) {
    tell({.field = "z_min_m", .allowed = "-1000 ... less than z_max_m"});
  }
  if (!(car.z_max_m <= kFarthestM)) {
    tell({.field = "z_max_m", .allowed = "at most 1000"});
  }
  check_span(footprint.x_min_m, footprint.x_max_m, "footprint.x_min_m",
             "-1000 ... x_max_m, which is at most 1000", tell);
  check_span(footprint.y_min_m, footprint.y_max_m, "footprint.y_min_m",
             "-1000 ... y_max_m, which is at most 1000", tell);
  if (!is_within(car.epsilon, kLeastEpsilon, kMostEpsilon)) {
    tell({.field = "epsilon", .allowed = "0.01 ... 0.4"});
  }
}

// A 1D cell much shorter than sigma cannot mark (thesis section 4.2.1.2, figure 4.6d). Above 4
// sigma, the model does not hold (sensor_model/single_target.hpp). With a large epsilon, index 1
// exceeds the probability of a hit. An arc provides less evidence than a beam.
bool can_mark(const Description& car, const SensorConfig& config) {
  const double ratio = config.precision_mm / (1000 * config.sigma_m);
  if (!is_within(ratio, 0.25, 4.0)) {
    return false;
  }
  const auto profile = sensor_model::profile_of(profile_config(car, config));
  return profile && profile->is_valid() &&
         (!lidar::facts_of(config.format).marks_arcs() || arc_of(car, config).is_given());
}

// Said by its own field; what is no number is no length of an angular cell either.
bool is_sigma_sound(const SensorConfig& config) {
  const lidar::ScannerFacts facts = lidar::facts_of(config.format);
  if (facts.is_ultrasonic) {
    return is_within(config.azimuth_sigma_deg, 2.0, 20.0);
  }
  return facts.is_radar ? is_within(config.azimuth_sigma_deg, 0.1, 1.0)
                        : config.azimuth_sigma_deg == 0;
}

void check_model(const Description& car, const SensorConfig& config, std::size_t number,
                 const Tell& tell) {
  if (!is_sigma_sound(config)) {
    tell({number, "azimuth_sigma_deg", car_block::kArcWords});
    return;
  }
  if (!is_within(config.sigma_m, 0.001, 1.0)) {
    tell({number, "sigma_m", "0.001 ... 1"});
  } else if (is_within<std::uint32_t>(config.precision_mm, 1, 1000) &&
             is_within(car.epsilon, kLeastEpsilon, kMostEpsilon) && !can_mark(car, config)) {
    Description usual = car;
    usual.epsilon = Description{}.epsilon;
    const bool is_epsilons_fault = can_mark(usual, config);
    tell({number, "precision_mm",
          is_epsilons_fault
              ? "longer, or a smaller epsilon: index 1 means more than a hit of this sensor "
                "(docs/model.md 4)"
              : "a length near sigma_m: with this one the sensor cannot mark (docs/model.md 4)"});
  }
}

void check_mount(const MountConfig& mount, std::size_t number, const Tell& tell) {
  const auto check = [&](double value, double least, double most, std::string_view field,
                         std::string_view allowed) {
    if (!is_within(value, least, most)) {
      tell({number, field, allowed});
    }
  };
  check(mount.x_m, -kFarthestM, kFarthestM, "mount.x_m", "-1000 ... 1000");
  check(mount.y_m, -kFarthestM, kFarthestM, "mount.y_m", "-1000 ... 1000");
  check(mount.z_m, -car_block::kOffCarMm / 1000.0, 10, "mount.z_m",
        "a place on the car: -0.15 ... 10");
  check(mount.yaw_deg, -360, 360, "mount.yaw_deg", "-360 ... 360");
  check(mount.pitch_deg, -90, 90, "mount.pitch_deg", "-90 ... 90");
  check(mount.roll_deg, -360, 360, "mount.roll_deg", "-360 ... 360");
}

void check_azimuths(const SensorConfig& config, std::uint16_t cell_mm, std::size_t number,
                    const Tell& tell) {
  const std::uint32_t steps = config.azimuth_steps_per_turn;
  const lidar::ScannerFacts facts = lidar::facts_of(config.format);
  if (!facts.turns) {
    if (steps != 0) {
      tell({number, "azimuth_steps_per_turn", "0, because this scanner does not turn"});
    }
    return;
  }
  const bool is_known = is_within(steps, vehicle::kFewestAzimuthSteps, vehicle::kMostAzimuthSteps);
  if (steps != 0 && !(is_known && std::has_single_bit(steps))) {
    tell({number, "azimuth_steps_per_turn", "256 ... 16384 in powers of two, or 0"});
  } else if (!vehicle::AzimuthSteps(facts.ticks_per_turn, steps_of(config, cell_mm)).is_valid()) {
    tell({number, "azimuth_steps_per_turn", "fewer: a turn has too many ticks to be rounded"});
  }
}

void check_mode(const SensorConfig& config, std::size_t number, const Tell& tell) {
  if (lidar::facts_of(config.format).has_modes) {
    if (!config.mode.is_valid()) {
      tell({number, "mode", "columns of a turn by turns of a second: 512x10 ... 2048x10"});
    }
  } else if (config.mode != lidar::TurnMode{}) {
    tell({number, "mode", "none, because packets of this scanner say theirs"});
  }
}

void check_tilt(const SensorConfig& config, std::size_t number, const Tell& tell) {
  if (!lidar::facts_of(config.format).has_beam_tilt) {
    if (config.beam_tilt_deg != 0) {
      tell({number, "beam_tilt_deg", "0, because the mirror of this scanner is not tilted"});
    }
  } else if (!is_within(config.beam_tilt_deg, kLeastBeamTiltDeg, kMostBeamTiltDeg)) {
    tell({number, "beam_tilt_deg", "0.2 ... 2, as the unit's parameter 0x3302 has it"});
  }
}

// Asked of the numbers of the file; what they are in millimetres is asked again with the tables.
void check_ground(const SensorConfig& config, std::size_t number, const Tell& tell) {
  if (!config.ground) {
    return;
  }
  const double low_m = config.ground->low_m;
  if (!is_within(low_m, 0.1, 1.0)) {
    tell({number, "ground.low_m", car_block::kGroundLowWords});
  } else if (!is_within(config.ground->top_m, low_m + 0.5, 10.0)) {
    tell({number, "ground.top_m", car_block::kGroundTopWords});
  }
}

void check_moved(const SensorConfig& config, std::size_t number, const Tell& tell) {
  if (config.moved && !is_within(config.moved->low_m, 0.1, 10.0)) {
    tell({number, "moved.low_m", car_block::kMovedLowWords});
  } else if (config.moved && !is_within(config.moved->tall_m, 0.0, 10.0)) {
    tell({number, "moved.tall_m", car_block::kMovedTallWords});
  }
}

void check_laser(const lidar::Laser& laser, std::size_t number, const Tell& tell) {
  if (!is_within(laser.elevation_deg, -89.0, 89.0)) {
    tell({number, "lasers", "an elevation_deg of -89 ... 89"});
  } else if (!is_within(laser.azimuth_deg, -30.0, 30.0)) {
    tell({number, "lasers", "an azimuth_deg of -30 ... 30"});
  } else if (!is_within(laser.height_m, -10.0, 10.0) ||
             !is_within(horizontal_range_m(laser), -10.0, 10.0)) {
    tell({number, "lasers", "height_m and range_m of which a range changes by -10 ... 10"});
  }
}

// Whose points say their directions.
bool are_of_points(std::span<const lidar::Laser> lasers) {
  return std::ranges::all_of(lasers,
                             [](const lidar::Laser& laser) {
                               return laser.azimuth_deg == 0 && laser.height_m == 0 &&
                                      laser.range_m == 0;
                             }) &&
         std::ranges::adjacent_find(lasers, [](const lidar::Laser& one, const lidar::Laser& next) {
           return !(one.elevation_deg + 0.001 <= next.elevation_deg);
         }) == lasers.end();
}

void check_lasers(const SensorConfig& config, std::size_t number, const Tell& tell) {
  const lidar::ScannerFacts facts = lidar::facts_of(config.format);
  if (facts.has_beam_tilt) {
    if (!config.lasers.empty()) {
      tell({number, "lasers", "none, because beam_tilt_deg says where its beams go"});
    }
    return;
  }
  const bool are_nominal = config.lasers.empty() && facts.has_elevations;
  if (!are_nominal && !lidar::can_have_layers(config.format, config.lasers.size())) {
    tell({number, "lasers",
          facts.has_elevations
              ? "one for each layer of the scanner, or none"
              : "one for each layer of the scanner, whose elevations are each unit's own"});
    return;
  }
  for (const lidar::Laser& laser : config.lasers) {
    check_laser(laser, number, tell);
  }
  if (facts.is_points && !are_of_points(config.lasers)) {
    tell({number, "lasers", car_block::kLayerWords});
  }
}

}  // namespace

void check(const Description& car, std::span<const SensorConfig> sensors, const Tell& tell) {
  check_car(car, tell);
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].range_max_mm == 0) {
      tell({i, "range_max_mm", car_block::kRangeWords});
    }
    check_model(car, sensors[i], i, tell);
    check_mount(sensors[i].mount, i, tell);
    check_azimuths(sensors[i], grid_of(car.grid).cell_mm, i, tell);
    check_mode(sensors[i], i, tell);
    check_tilt(sensors[i], i, tell);
    check_lasers(sensors[i], i, tell);
    check_ground(sensors[i], i, tell);
    check_moved(sensors[i], i, tell);
  }
}

}  // namespace iog::description
