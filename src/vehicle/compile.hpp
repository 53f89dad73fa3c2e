// From a description to a vehicle: rounds, and computes every table. Usually at compile time; a
// car's file is compiled by the PC's tools, too.
//
// A description that breaks a limit (vehicle/limits.hpp) does not compile: the compiler shows which
// fault was told.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/grid.hpp"
#include "lidar/formats.hpp"
#include "numeric/elementary.hpp"
#include "vehicle/derived.hpp"
#include "vehicle/identity.hpp"
#include "vehicle/limits.hpp"
#include "vehicle/scanner_facts.hpp"
#include "vehicle/tilted_mirror.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicle {

// Not constexpr and never defined: reaching it ends the compilation.
void a_description_breaks_a_limit(const Fault& fault);

namespace compile_detail {

// Rz(yaw) Ry(pitch) Rx(roll), column by column: the sensor's forward, left and up in the vehicle.
struct Rotation {
  std::array<double, 3> forward;
  std::array<double, 3> left;
  std::array<double, 3> up;
};

constexpr Rotation rotation_of(const MountConfig& mount) {
  const double cy = numeric::cos(radians(mount.yaw_deg));
  const double sy = numeric::sin(radians(mount.yaw_deg));
  const double cp = numeric::cos(radians(mount.pitch_deg));
  const double sp = numeric::sin(radians(mount.pitch_deg));
  const double cr = numeric::cos(radians(mount.roll_deg));
  const double sr = numeric::sin(radians(mount.roll_deg));
  return {.forward = {cy * cp, sy * cp, -sp},
          .left = {cy * sp * sr - sy * cr, sy * sp * sr + cy * cr, cp * sr},
          .up = {cy * sp * cr + sy * sr, sy * sp * cr - cy * sr, cp * cr}};
}

constexpr std::int32_t subcells(double metres) {
  return static_cast<std::int32_t>(numeric::round(metres * geometry::kSubcellsPerMetre));
}

// x and y are measured from the grid's corner, the vehicle's origin is in the middle.
constexpr double grid_metres(double vehicle_metres) {
  return vehicle_metres + geometry::kOriginCell * geometry::kCellMm / 1000.0;
}

constexpr EndCoordinate end_coordinate(double origin_m, double length_m, double elevation,
                                       double forward, double left, double up) {
  const double unit = geometry::kSubcellsPerMetre * (1 << kAxisFractionBits);
  const double reach = length_m * numeric::cos(elevation) * unit;
  return {.base = numeric::round((origin_m + length_m * numeric::sin(elevation) * up) * unit),
          .forward = static_cast<std::int32_t>(numeric::round(reach * forward)),
          .left = static_cast<std::int32_t>(numeric::round(reach * left))};
}

// The beams of a layer, each with its own line.
constexpr Layer layer_of(const MountConfig& mount, const Rotation& turn, double length_m,
                         double elevation) {
  const auto along = [&](double origin_m, std::size_t axis) {
    return end_coordinate(origin_m, length_m, elevation, turn.forward[axis], turn.left[axis],
                          turn.up[axis]);
  };
  return {.x = along(grid_metres(mount.x_m), 0),
          .y = along(grid_metres(mount.y_m), 1),
          .z = along(mount.z_m, 2)};
}

// The same on the lines of elevation 0, above the end of which a beam passes at z + L
// tan(elevation).
constexpr Layer shared_layer_of(const MountConfig& mount, const Rotation& turn, double length_m,
                                double elevation) {
  const double unit = geometry::kSubcellsPerMetre * (1 << kAxisFractionBits);
  Layer layer = layer_of(mount, turn, length_m, 0);
  layer.z = {.base = numeric::round((mount.z_m + length_m * tangent(elevation)) * unit)};
  layer.range_share = static_cast<std::uint32_t>(
      numeric::round(numeric::cos(elevation) * (1 << numeric::kSineFractionBits)));
  return layer;
}

// The beams of a layer of a tilted mirror.
constexpr Layer fitted_layer_of(const MountConfig& mount, const Rotation& turn, double length_m,
                                const FittedDirections& fit) {
  const double unit = geometry::kSubcellsPerMetre * (1 << kAxisFractionBits);
  const auto coordinate = [&](double origin_m, std::size_t axis) -> EndCoordinate {
    const auto reach = [&](const std::array<double, 3>& part) {
      return length_m *
             (part[0] * turn.forward[axis] + part[1] * turn.left[axis] + part[2] * turn.up[axis]);
    };
    return {.base = numeric::round((origin_m + reach(fit.base)) * unit),
            .forward = static_cast<std::int32_t>(numeric::round(reach(fit.forward) * unit)),
            .left = static_cast<std::int32_t>(numeric::round(reach(fit.left) * unit))};
  };
  return {.x = coordinate(grid_metres(mount.x_m), 0),
          .y = coordinate(grid_metres(mount.y_m), 1),
          .z = coordinate(mount.z_m, 2)};
}

// How high over the unit's origin its beams start, on the average. They differ by some centimetres,
// and the height band is asked of all alike.
constexpr double mean_height_m(std::span<const lidar::Laser> lasers) {
  double sum = 0;
  for (const lidar::Laser& laser : lasers) {
    sum += laser.height_m / numeric::cos(radians(laser.elevation_deg));
  }
  return lasers.empty() ? 0 : sum / static_cast<double>(lasers.size());
}

// The tick nearest to a laser's azimuth, a tie away from 0. Half a hundredth of a degree is no
// double, so the degrees are taken for the decimal number that was meant: to 1e-9.
constexpr std::int16_t nearest_tick(double azimuth_deg, std::int32_t ticks_per_turn) {
  constexpr std::int64_t kPartsPerTurn = 360'000'000'000;
  const std::int64_t doubled = 2 * numeric::round(azimuth_deg * 1e9) * ticks_per_turn;
  const std::int64_t half = azimuth_deg < 0 ? -kPartsPerTurn : kPartsPerTurn;
  return static_cast<std::int16_t>((doubled + half) / (2 * kPartsPerTurn));
}

constexpr lidar::LaserCorrection correction_of(const lidar::Laser& laser,
                                               std::int32_t ticks_per_turn) {
  return {.azimuth_ticks = nearest_tick(laser.azimuth_deg, ticks_per_turn),
          .range_mm = static_cast<std::int16_t>(numeric::round(horizontal_range_m(laser) * 1000))};
}

// The unit's own elevations, or those of its format.
struct Elevations {
  std::size_t count = 0;
  std::array<double, kMaxLayers> deg{};
};

template <typename Decoder>
constexpr Elevations elevations_of(const SensorConfig& config) {
  Elevations elevations;
  if (config.lasers.empty()) {
    elevations.count = Decoder::kElevationsDeg.size();
    std::ranges::copy(Decoder::kElevationsDeg, elevations.deg.begin());
  } else {
    elevations.count = config.lasers.size();
    std::ranges::transform(config.lasers, elevations.deg.begin(), &lidar::Laser::elevation_deg);
  }
  return elevations;
}

constexpr void compile_corrections(const SensorConfig& config, std::int32_t ticks_per_turn,
                                   Sensor& sensor) {
  sensor.is_calibrated = !config.lasers.empty();
  for (std::size_t i = 0; i < config.lasers.size(); ++i) {
    sensor.laser_corrections[i] = correction_of(config.lasers[i], ticks_per_turn);
  }
}

// Says of the layer whose lines it has.
constexpr void add_layer(const Layer& layer, std::size_t number, Sensor& sensor) {
  sensor.layers[number] = layer;
  const auto same_line = [&](const Layer& other) {
    return other.x == layer.x && other.y == layer.y;
  };
  const auto first = std::ranges::find_if(sensor.layers, same_line);
  sensor.layers[number].line = static_cast<std::uint8_t>(first - sensor.layers.begin());
}

template <typename Decoder>
constexpr void compile_tilted_layers(const SensorConfig& config, Sensor& sensor) {
  const Rotation turn = rotation_of(config.mount);
  const double length_m = config.range_max_mm / 1000.0;
  const auto angle_of = [](std::int32_t ticks) {
    return radians(ticks * 360.0 / Decoder::kTicksPerTurn);
  };
  sensor.layer_count = static_cast<std::uint8_t>(Decoder::kElevationsDeg.size());
  for (std::size_t i = 0; i < Decoder::kElevationsDeg.size(); ++i) {
    const FittedDirections fit = fit_directions(
        angle_of(Decoder::kRightmostTicks), angle_of(Decoder::kLeftmostTicks), [&](double azimuth) {
          return tilted_elevation(radians(Decoder::kElevationsDeg[i]), Decoder::looks_up(i),
                                  radians(config.beam_tilt_deg), azimuth);
        });
    add_layer(fitted_layer_of(config.mount, turn, length_m, fit), i, sensor);
  }
}

constexpr void compile_layers(const SensorConfig& config, std::span<const double> elevations_deg,
                              Sensor& sensor) {
  const Rotation turn = rotation_of(config.mount);
  const double length_m = config.range_max_mm / 1000.0;
  MountConfig mount = config.mount;
  mount.z_m += mean_height_m(config.lasers);
  sensor.layer_count = static_cast<std::uint8_t>(elevations_deg.size());
  for (std::size_t i = 0; i < elevations_deg.size(); ++i) {
    const double elevation = radians(elevations_deg[i]);
    add_layer(sensor.layers_share_lines ? shared_layer_of(mount, turn, length_m, elevation)
                                        : layer_of(mount, turn, length_m, elevation),
              i, sensor);
  }
}

constexpr Footprint footprint_of(const FootprintConfig& config) {
  return {.x_min = subcells(grid_metres(config.x_min_m)),
          .x_max = subcells(grid_metres(config.x_max_m)),
          .y_min = subcells(grid_metres(config.y_min_m)),
          .y_max = subcells(grid_metres(config.y_max_m))};
}

// A sensor that turns and is level has one line an azimuth for all layers.
template <typename Decoder>
constexpr void compile_azimuths(const SensorConfig& config, Sensor& sensor) {
  if constexpr (Decoder::kTurns) {
    derive_azimuths<Decoder>(steps_of(config), sensor);
    sensor.layers_share_lines = config.mount.pitch_deg == 0 && config.mount.roll_deg == 0;
  } else {
    derive_azimuths<Decoder>(Decoder::kTicksPerTurn, sensor);
  }
}

template <typename Decoder>
constexpr void compile_mode(const SensorConfig& config, Sensor& sensor) {
  if constexpr (HasModes<Decoder>) {
    sensor.columns_per_turn = config.mode.columns_per_turn;
    sensor.column_ns = config.mode.column_ns();
  }
}

}  // namespace compile_detail

// Of what keeps to its limits.
constexpr Sensor compile_sensor(const SensorConfig& config, const Description& description) {
  using compile_detail::grid_metres;
  using compile_detail::subcells;
  Sensor sensor;
  sensor.name = config.name;
  sensor.format = config.format;
  sensor.source_ipv4 = config.source_ipv4;
  sensor.udp_port = config.udp_port;
  sensor.origin = {subcells(grid_metres(config.mount.x_m)),
                   subcells(grid_metres(config.mount.y_m))};
  sensor.origin_z = subcells(config.mount.z_m + compile_detail::mean_height_m(config.lasers));
  sensor.range = traversal::LineLength(config.range_max_mm);
  sensor.range_min_mm = config.range_min_mm;
  sensor.precision_mm = config.precision_mm;
  sensor.no_return_clears_mm = config.no_return_clears_mm;
  sensor.scan_width_ticks = config.scan_width_ticks;
  sensor.max_points_per_scan = config.max_points_per_scan;
  sensor.is_synchronised = config.is_synchronised;
  sensor.latency_us = config.latency_us;
  sensor.profile = *sensor_model::profile_of(profile_config(description, config));
  derive_limits(compile_detail::footprint_of(description.footprint), subcells(description.z_min_m),
                subcells(description.z_max_m), sensor);
  lidar::with_decoder(config.format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    const compile_detail::Elevations elevations = compile_detail::elevations_of<Decoder>(config);
    compile_detail::compile_mode<Decoder>(config, sensor);
    compile_detail::compile_azimuths<Decoder>(config, sensor);
    compile_detail::compile_corrections(config, Decoder::kTicksPerTurn, sensor);
    if constexpr (HasBeamTilt<Decoder>) {
      compile_detail::compile_tilted_layers<Decoder>(config, sensor);
    } else {
      compile_detail::compile_layers(config, std::span(elevations.deg).first(elevations.count),
                                     sensor);
    }
  });
  return sensor;
}

// The vehicle of sensors that are compiled; of what keeps to its limits. Sensors outlive it.
constexpr Vehicle join_vehicle(const Description& description, std::span<const Sensor> sensors) {
  using compile_detail::subcells;
  Vehicle vehicle{.name = description.name,
                  .sensors = sensors,
                  .footprint = compile_detail::footprint_of(description.footprint),
                  .z_min = subcells(description.z_min_m),
                  .z_max = subcells(description.z_max_m),
                  .rule = description.rule,
                  .quantisation = description.quantisation,
                  .frame_period_us = description.frame_period_us,
                  .grids = description.grids,
                  .poses = description.poses,
                  .maps = description.maps,
                  .window = description.window};
  vehicle.id = identity_of(vehicle);
  return vehicle;
}

template <std::size_t kCount>
consteval std::array<Sensor, kCount> compile_sensors(
    const std::array<SensorConfig, kCount>& configs, const Description& description) {
  static_assert(kCount >= 1 && kCount <= kMaxSensors);
  std::array<Sensor, kCount> sensors;
  for (std::size_t i = 0; i < kCount; ++i) {
    check_sensor(description, configs[i], i, a_description_breaks_a_limit);
    sensors[i] = compile_sensor(configs[i], description);
  }
  return sensors;
}

// sensors: of static storage, usually the constexpr result of compile_sensors().
consteval Vehicle compile_vehicle(const Description& description, std::span<const Sensor> sensors) {
  check_description(description, a_description_breaks_a_limit);
  check_classes(description, a_description_breaks_a_limit);
  check_ports(description, sensors, a_description_breaks_a_limit);
  check_lines(sensors, a_description_breaks_a_limit);
  return join_vehicle(description, sensors);
}

}  // namespace iog::vehicle
