// The limits of a description beyond which its tables cannot be computed, or no target could run
// them. compile.hpp checks them in every description; src/description checks more in a car's file.
#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "geometry/grid.hpp"
#include "lidar/formats.hpp"
#include "sensor_model/profile.hpp"
#include "vehicle/azimuth_steps.hpp"
#include "vehicle/description.hpp"
#include "vehicle/fault.hpp"
#include "vehicle/scanner_facts.hpp"
#include "vehicle/tilted_mirror.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicle {

inline constexpr std::uint32_t kLongestRangeMm = 130'000;

// Coordinates stay within this, so that products of subcells stay within 64 bits.
inline constexpr double kFarthestM = 1000;

// A length in subcells, rounded up. length_mm <= kLongestRangeMm.
constexpr std::uint64_t subcells_up(std::uint32_t length_mm) {
  return (std::uint64_t{length_mm} * geometry::kResolution + geometry::kCellMm - 1) /
         geometry::kCellMm;
}

// Whether the error term of the walk stays below 2^31 along beams of this length: a line spans at
// most sqrt(2) L in |dx| + |dy|, to which rounding adds less than 10 subcells.
constexpr bool walk_fits(std::uint32_t range_mm) {
  const std::uint64_t span = subcells_up(range_mm) * 1'414'214 / 1'000'000 + 10;
  return span * geometry::kResolution < std::uint64_t{1} << 31;
}

// No end of a beam is farther away: those of a tilted mirror are fitted
// (vehicle/tilted_mirror.hpp), and at azimuths that it cannot see they may lie beyond the range.
// range_mm <= kLongestRangeMm.
constexpr std::uint32_t longest_line_mm(lidar::Format format, std::uint32_t range_mm) {
  return facts_of(format).has_beam_tilt ? range_mm + range_mm / 64 + 1 : range_mm;
}

namespace limits_detail {

constexpr void check_range(const SensorConfig& config, std::size_t number, auto&& tell) {
  if (config.range_max_mm <= config.range_min_mm || config.range_max_mm > kLongestRangeMm) {
    tell(Fault{number, "range_max_mm", "more than range_min_mm, at most 130000"});
    return;
  }
  if (config.no_return_clears_mm > config.range_max_mm) {
    tell(Fault{number, "no_return_clears_mm", "at most range_max_mm"});
  }
  const std::uint32_t longest_mm = longest_line_mm(config.format, config.range_max_mm);
  if (longest_mm > kLongestRangeMm) {
    tell(Fault{number, "range_max_mm", "at most 127999, because its mirror is tilted"});
  } else if (!walk_fits(longest_mm)) {
    tell(Fault{number, "range_max_mm",
               "less: the error term of the walk along the longest beam overflows"});
  }
}

// A 1D cell much shorter than sigma cannot mark (thesis section 4.2.1.2, figure 4.6d); of one above
// 4 sigma the model does not hold (sensor_model/single_target.hpp).
constexpr bool can_mark(const Description& car, const SensorConfig& config) {
  const double ratio = config.precision_mm / (1000 * config.sigma_m);
  if (!is_within(ratio, 0.25, 4.0)) {
    return false;
  }
  const auto profile = sensor_model::profile_of(profile_config(car, config));
  return profile && profile->is_valid();
}

constexpr void check_model(const Description& car, const SensorConfig& config, std::size_t number,
                           auto&& tell) {
  if (config.precision_mm == 0 || config.precision_mm > 1000) {
    tell(Fault{number, "precision_mm", "1 ... 1000"});
  } else if (!is_within(config.sigma_m, 0.001, 1.0)) {
    tell(Fault{number, "sigma_m", "0.001 ... 1"});
  } else if (is_within(car.epsilon, kLeastEpsilon, kMostEpsilon) && !can_mark(car, config)) {
    tell(Fault{number, "precision_mm",
               "a length near sigma_m: with this one the sensor cannot mark (docs/model.md 4)"});
  }
}

constexpr void check_mount(const MountConfig& mount, std::size_t number, auto&& tell) {
  const auto check = [&](double value, double most, std::string_view field,
                         std::string_view allowed) {
    if (!is_within(value, -most, most)) {
      tell(Fault{number, field, allowed});
    }
  };
  check(mount.x_m, kFarthestM, "mount.x_m", "-1000 ... 1000");
  check(mount.y_m, kFarthestM, "mount.y_m", "-1000 ... 1000");
  check(mount.z_m, kFarthestM, "mount.z_m", "-1000 ... 1000");
  check(mount.yaw_deg, 360, "mount.yaw_deg", "-360 ... 360");
  check(mount.pitch_deg, 90, "mount.pitch_deg", "-90 ... 90");
  check(mount.roll_deg, 360, "mount.roll_deg", "-360 ... 360");
}

constexpr void check_azimuths(const SensorConfig& config, std::size_t number, auto&& tell) {
  const std::uint32_t steps = config.azimuth_steps_per_turn;
  const ScannerFacts facts = facts_of(config.format);
  if (!facts.turns) {
    if (steps != 0) {
      tell(Fault{number, "azimuth_steps_per_turn", "0, because this scanner does not turn"});
    }
    return;
  }
  const bool is_known = is_within(steps, kFewestAzimuthSteps, kMostAzimuthSteps);
  if (steps != 0 && !(is_known && std::has_single_bit(steps))) {
    tell(Fault{number, "azimuth_steps_per_turn", "256 ... 16384 in powers of two, or 0"});
  } else if (!AzimuthSteps(facts.ticks_per_turn, steps_of(config)).is_valid()) {
    tell(Fault{number, "azimuth_steps_per_turn", "fewer: a turn has too many ticks to be rounded"});
  }
}

constexpr void check_mode(const SensorConfig& config, std::size_t number, auto&& tell) {
  const bool is_given = config.mode.columns_per_turn != 0 || config.mode.turns_per_second != 0;
  if (facts_of(config.format).has_modes) {
    if (!config.mode.is_valid()) {
      tell(Fault{number, "mode", "columns of a turn by turns of a second: 512x10 ... 2048x10"});
    }
  } else if (is_given) {
    tell(Fault{number, "mode", "none, because packets of this scanner say theirs"});
  }
}

constexpr void check_tilt(const SensorConfig& config, std::size_t number, auto&& tell) {
  if (!facts_of(config.format).has_beam_tilt) {
    if (config.beam_tilt_deg != 0) {
      tell(Fault{number, "beam_tilt_deg", "0, because the mirror of this scanner is not tilted"});
    }
    return;
  }
  if (!is_within(config.beam_tilt_deg, kLeastBeamTiltDeg, kMostBeamTiltDeg)) {
    tell(Fault{number, "beam_tilt_deg", "0.2 ... 2, as the unit's parameter 0x3302 has it"});
  }
}

constexpr void check_lasers(const SensorConfig& config, std::size_t number, auto&& tell) {
  const ScannerFacts facts = facts_of(config.format);
  if (facts.has_beam_tilt) {
    if (!config.lasers.empty()) {
      tell(Fault{number, "lasers", "none, because beam_tilt_deg says where its beams go"});
    }
    return;
  }
  const bool are_nominal = config.lasers.empty() && facts.has_elevations;
  if (!are_nominal && !can_have_layers(config.format, config.lasers.size())) {
    tell(Fault{number, "lasers",
               facts.has_elevations ? "one for each layer of the scanner, or none"
                                    : "one for each layer of the scanner, whose elevations are "
                                      "each unit's own"});
    return;
  }
  if (facts.layers > kMaxLayers) {
    tell(Fault{number, "type", "a scanner of at most 128 layers"});
  }
  for (const lidar::Laser& laser : config.lasers) {
    if (!is_within(laser.elevation_deg, -89.0, 89.0)) {
      tell(Fault{number, "lasers", "an elevation_deg of -89 ... 89"});
    } else if (!is_within(laser.azimuth_deg, -30.0, 30.0)) {
      tell(Fault{number, "lasers", "an azimuth_deg of -30 ... 30"});
    } else if (!is_within(laser.height_m, -10.0, 10.0) ||
               !is_within(horizontal_range_m(laser), -10.0, 10.0)) {
      tell(Fault{number, "lasers", "height_m and range_m of which a range changes by -10 ... 10"});
    }
  }
}

}  // namespace limits_detail

constexpr void check_sensor(const Description& car, const SensorConfig& config, std::size_t number,
                            auto&& tell) {
  limits_detail::check_range(config, number, tell);
  limits_detail::check_model(car, config, number, tell);
  limits_detail::check_mount(config.mount, number, tell);
  limits_detail::check_azimuths(config, number, tell);
  limits_detail::check_mode(config, number, tell);
  limits_detail::check_tilt(config, number, tell);
  limits_detail::check_lasers(config, number, tell);
  if (config.udp_port == 0) {
    tell(Fault{number, "udp_port", "1 ... 65535"});
  }
  if (config.scan_width_ticks == 0 ||
      config.scan_width_ticks > facts_of(config.format).ticks_per_turn) {
    tell(Fault{number, "scan_width_ticks", "1 ... a whole turn in ticks of the scanner"});
  }
  if (config.max_points_per_scan <
      std::max(fewest_points(config.format, config.lasers.size()), std::size_t{1})) {
    tell(Fault{number, "max_points_per_scan", kFewestPointsWords});
  }
}

// What does not depend on a sensor.
constexpr void check_description(const Description& car, auto&& tell) {
  const FootprintConfig& its = car.footprint;
  if (!is_within(car.z_min_m, -kFarthestM, kFarthestM) || !(car.z_min_m < car.z_max_m)) {
    tell(Fault{.field = "z_min_m", .allowed = "-1000 ... less than z_max_m"});
  }
  if (!(car.z_max_m <= kFarthestM)) {
    tell(Fault{.field = "z_max_m", .allowed = "at most 1000"});
  }
  if (!is_within(its.x_min_m, -kFarthestM, kFarthestM) || !(its.x_min_m <= its.x_max_m) ||
      !(its.x_max_m <= kFarthestM)) {
    tell(
        Fault{.field = "footprint.x_min_m", .allowed = "-1000 ... x_max_m, which is at most 1000"});
  }
  if (!is_within(its.y_min_m, -kFarthestM, kFarthestM) || !(its.y_min_m <= its.y_max_m) ||
      !(its.y_max_m <= kFarthestM)) {
    tell(
        Fault{.field = "footprint.y_min_m", .allowed = "-1000 ... y_max_m, which is at most 1000"});
  }
  if (!is_within(car.epsilon, kLeastEpsilon, kMostEpsilon)) {
    tell(Fault{.field = "epsilon", .allowed = "0.01 ... 0.4"});
  }
}

// Classes need the rule hits_win, by which alone slices of a frame join, and blurring, because
// nearest calls cells behind a hit occupied.
// AnyCar: Description or Vehicle.
template <typename AnyCar>
constexpr void check_classes(const AnyCar& car, auto&& tell) {
  if (!have_classes(car.grids)) {
    return;
  }
  if (car.rule != FusionRule::kHitsWin) {
    tell(Fault{.field = "rule", .allowed = "hits_win, because grids have classes"});
  }
  if (car.quantisation != index::Quantisation::kBlurring) {
    tell(Fault{.field = "quantisation", .allowed = "blurring, because grids have classes"});
  }
  if (car.poses.log2_slice_ms > 6) {
    tell(Fault{.field = "poses.log2_slice_ms", .allowed = "0 ... 6: slices of at most 64 ms"});
  }
}

// Description or Vehicle; SensorConfig or Sensor.
template <typename AnyCar, typename AnySensor>
constexpr void check_ports(const AnyCar& car, std::span<const AnySensor> sensors, auto&& tell) {
  if (!have_classes(car.grids)) {
    return;
  }
  const auto is_sensors_port = [&](std::uint16_t udp_port) {
    return std::ranges::find(sensors, udp_port, &AnySensor::udp_port) != sensors.end();
  };
  if (car.poses.udp_port == 0 || is_sensors_port(car.poses.udp_port)) {
    tell(Fault{.field = "poses.udp_port", .allowed = "1 ... 65535, and no sensor's port"});
  }
  if (car.maps.udp_port == 0 || is_sensors_port(car.maps.udp_port) ||
      car.maps.udp_port == car.poses.udp_port) {
    tell(Fault{.field = "maps.udp_port",
               .allowed = "1 ... 65535, and neither a sensor's port nor that of the poses"});
  }
}

constexpr void check_lines(std::span<const Sensor> sensors, auto&& tell) {
  std::size_t lines = 0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    lines += sensors[i].layers_share_lines ? sensors[i].azimuths.steps_per_turn() : 0;
    if (lines > kMaxTurnLines) {
      tell(Fault{i, "azimuth_steps_per_turn",
                 "fewer: level sensors that turn have 8192 lines together, one for each step"});
      return;
    }
  }
}

}  // namespace iog::vehicle
