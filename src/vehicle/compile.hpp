// From a description to a vehicle, at compile time: validates, rounds, and computes every table.
//
// A description that breaks a limit does not compile: the compiler names the function below that
// was reached.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "geometry/grid.hpp"
#include "numeric/elementary.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicle {

// Not constexpr and never defined: reaching one of them ends the compilation with its name.
void a_sensor_needs_a_range_between_its_minimum_and_130_metres();
void a_sensor_needs_a_precision_of_at_least_1_mm_and_a_positive_sigma();
void a_sensor_needs_an_udp_port_a_scan_width_and_a_point_limit();
void the_longest_beam_overflows_the_error_term_of_the_walk();
void this_sensor_cannot_mark_its_cells_are_too_short_for_its_precision();
void the_height_band_or_the_footprint_is_empty();

namespace compile_detail {

// Rz(yaw) Ry(pitch) Rx(roll), column by column: the sensor's forward, left and up in the vehicle.
struct Rotation {
  std::array<double, 3> forward;
  std::array<double, 3> left;
  std::array<double, 3> up;
};

constexpr double radians(double degrees) { return degrees * numeric::kPi / 180; }

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

constexpr void compile_layers(const SensorConfig& config, std::span<const double> elevations_deg,
                              Sensor& sensor) {
  const Rotation turn = rotation_of(config.mount);
  const double length_m = config.range_max_mm / 1000.0;
  sensor.layer_count = static_cast<std::uint8_t>(elevations_deg.size());
  for (std::size_t i = 0; i < elevations_deg.size(); ++i) {
    const double elevation = radians(elevations_deg[i]);
    const auto along = [&](double origin_m, std::size_t axis) {
      return end_coordinate(origin_m, length_m, elevation, turn.forward[axis], turn.left[axis],
                            turn.up[axis]);
    };
    sensor.layers[i] = {.x = along(grid_metres(config.mount.x_m), 0),
                        .y = along(grid_metres(config.mount.y_m), 1),
                        .z = along(config.mount.z_m, 2)};
    const auto same_line = [&](const Layer& layer) {
      return layer.x == sensor.layers[i].x && layer.y == sensor.layers[i].y;
    };
    const auto first = std::ranges::find_if(sensor.layers, same_line);
    sensor.layers[i].line = static_cast<std::uint8_t>(first - sensor.layers.begin());
  }
}

constexpr void check(const SensorConfig& config) {
  if (config.range_max_mm <= config.range_min_mm || config.range_max_mm > 130'000 ||
      config.no_return_clears_mm > config.range_max_mm) {
    a_sensor_needs_a_range_between_its_minimum_and_130_metres();
  }
  if (config.precision_mm == 0 || !(config.sigma_m > 0)) {
    a_sensor_needs_a_precision_of_at_least_1_mm_and_a_positive_sigma();
  }
  if (config.udp_port == 0 || config.scan_width_ticks == 0 || config.max_points_per_scan == 0) {
    a_sensor_needs_an_udp_port_a_scan_width_and_a_point_limit();
  }
  // The longest line spans at most sqrt(2) L in |dx| + |dy|, and rounding adds 2 subcells.
  const double span = config.range_max_mm / 1000.0 * geometry::kSubcellsPerMetre * 1.41421357 + 2;
  if (span * geometry::kResolution >= 2147483648.0) {
    the_longest_beam_overflows_the_error_term_of_the_walk();
  }
}

constexpr RangeProducts range_products(double low_m, double high_m, std::int32_t origin,
                                       std::uint32_t length_mm) {
  return {.low = (std::int64_t{subcells(low_m)} - origin) * length_mm,
          .high = (std::int64_t{subcells(high_m)} - origin) * length_mm};
}

constexpr void compile_limits(const Description& description, Sensor& sensor) {
  const FootprintConfig& car = description.footprint;
  const std::uint32_t length_mm = sensor.range.mm();
  sensor.on_car_x = range_products(grid_metres(car.x_min_m), grid_metres(car.x_max_m),
                                   sensor.origin.x, length_mm);
  sensor.on_car_y = range_products(grid_metres(car.y_min_m), grid_metres(car.y_max_m),
                                   sensor.origin.y, length_mm);
  sensor.in_band =
      range_products(description.z_min_m, description.z_max_m, sensor.origin_z, length_mm);
}

constexpr Sensor compile_sensor(const SensorConfig& config, const Description& description) {
  check(config);
  Sensor sensor;
  sensor.name = config.name;
  sensor.format = config.format;
  sensor.source_ipv4 = config.source_ipv4;
  sensor.udp_port = config.udp_port;
  sensor.origin = {subcells(grid_metres(config.mount.x_m)),
                   subcells(grid_metres(config.mount.y_m))};
  sensor.origin_z = subcells(config.mount.z_m);
  sensor.range = traversal::LineLength(config.range_max_mm);
  sensor.range_min_mm = config.range_min_mm;
  sensor.precision_mm = config.precision_mm;
  sensor.precision = numeric::Reciprocal(config.precision_mm);
  sensor.no_return_clears_mm = config.no_return_clears_mm;
  sensor.scan_width_ticks = config.scan_width_ticks;
  sensor.max_points_per_scan = config.max_points_per_scan;
  sensor.profile = sensor_model::make_profile({.sigma_m = config.sigma_m,
                                               .cell_length_m = config.precision_mm / 1000.0,
                                               .epsilon = description.epsilon,
                                               .quantisation = description.quantisation});
  if (!sensor.profile.is_valid()) {
    this_sensor_cannot_mark_its_cells_are_too_short_for_its_precision();
  }
  compile_limits(description, sensor);
  switch (config.format) {
    case lidar::Format::kIbeoLux:
      sensor.sines = numeric::kSineTable<lidar::IbeoLux::kTicksPerTurn>;
      compile_layers(config, lidar::IbeoLux::kElevationsDeg, sensor);
      break;
    case lidar::Format::kVelodyneVlp16:
      sensor.sines = numeric::kSineTable<lidar::VelodyneVlp16::kTicksPerTurn>;
      compile_layers(config, lidar::VelodyneVlp16::kElevationsDeg, sensor);
      break;
  }
  return sensor;
}

}  // namespace compile_detail

template <std::size_t kCount>
consteval std::array<Sensor, kCount> compile_sensors(
    const std::array<SensorConfig, kCount>& configs, const Description& description) {
  static_assert(kCount >= 1 && kCount <= kMaxSensors);
  std::array<Sensor, kCount> sensors;
  for (std::size_t i = 0; i < kCount; ++i) {
    sensors[i] = compile_detail::compile_sensor(configs[i], description);
  }
  return sensors;
}

// sensors: of static storage, usually the constexpr result of compile_sensors().
consteval Vehicle compile_vehicle(const Description& description, std::span<const Sensor> sensors) {
  using compile_detail::grid_metres;
  using compile_detail::subcells;
  const FootprintConfig& footprint = description.footprint;
  if (!(description.z_min_m < description.z_max_m) || footprint.x_min_m > footprint.x_max_m ||
      footprint.y_min_m > footprint.y_max_m) {
    the_height_band_or_the_footprint_is_empty();
  }
  return {.name = description.name,
          .sensors = sensors,
          .footprint = {.x_min = subcells(grid_metres(footprint.x_min_m)),
                        .x_max = subcells(grid_metres(footprint.x_max_m)),
                        .y_min = subcells(grid_metres(footprint.y_min_m)),
                        .y_max = subcells(grid_metres(footprint.y_max_m))},
          .z_min = subcells(description.z_min_m),
          .z_max = subcells(description.z_max_m),
          .rule = description.rule,
          .frame_period_us = description.frame_period_us};
}

}  // namespace iog::vehicle
