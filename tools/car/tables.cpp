#include "tools/car/tables.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

#include "car_block/content.hpp"
#include "car_block/limits.hpp"
#include "geometry/grid.hpp"
#include "lidar/formats.hpp"
#include "lidar/scanner_facts.hpp"
#include "numeric/elementary.hpp"
#include "tools/car/mount.hpp"
#include "tools/car/tilted_mirror.hpp"
#include "vehicle/derived.hpp"
#include "vehicle/fault.hpp"

namespace iog::description {
namespace {

using vehicle::EndCoordinate;
using vehicle::Layer;
using vehicle::Sensor;
using vehicle::Vehicle;

// Converts lengths to subcells. The scale is exact, because the cell size in mm divides 1000.
double subcells_per_metre(const geometry::Grid& grid) {
  return 1000.0 / grid.cell_mm * geometry::kResolution;
}

double tangent(double elevation) { return numeric::sin(elevation) / numeric::cos(elevation); }

std::int32_t subcells(double metres, const geometry::Grid& grid) {
  return static_cast<std::int32_t>(numeric::round(metres * subcells_per_metre(grid)));
}

// 0 of what cannot be the height of a limit.
std::uint16_t millimetres(double metres) {
  return metres > 0 && metres < 60 ? static_cast<std::uint16_t>(numeric::round(metres * 1000))
                                   : std::uint16_t{0};
}

// Returns 0, which is refused, if the value is not a valid epsilon.
std::uint16_t hundred_thousandths(double epsilon) {
  return epsilon > 0 && epsilon < 0.5 ? static_cast<std::uint16_t>(numeric::round(epsilon * 1e5))
                                      : std::uint16_t{0};
}

// x and y are measured from the grid's corner.
double grid_x(double vehicle_x_m, const geometry::Grid& grid) {
  return vehicle_x_m + grid.origin_column * grid.cell_mm / 1000.0;
}
double grid_y(double vehicle_y_m, const geometry::Grid& grid) {
  return vehicle_y_m + grid.origin_row * grid.cell_mm / 1000.0;
}

// How high over the unit's origin its beams start, on the average. They differ by some centimetres,
// and the height band is asked of all alike.
double mean_height_m(std::span<const lidar::Laser> lasers) {
  double sum = 0;
  for (const lidar::Laser& laser : lasers) {
    sum += laser.height_m / numeric::cos(radians(laser.elevation_deg));
  }
  return lasers.empty() ? 0 : sum / static_cast<double>(lasers.size());
}

// Half a hundredth of a degree is no double, so the degrees are taken for the decimal number that
// was meant: to 1e-9.
std::int16_t nearest_tick(double azimuth_deg, std::int32_t ticks_per_turn) {
  constexpr std::int64_t kPartsPerTurn = 360'000'000'000;
  const std::int64_t doubled = 2 * numeric::round(azimuth_deg * 1e9) * ticks_per_turn;
  const std::int64_t half = azimuth_deg < 0 ? -kPartsPerTurn : kPartsPerTurn;
  return static_cast<std::int16_t>((doubled + half) / (2 * kPartsPerTurn));
}

// Where beams start, along which axes they go, and how far.
struct Place {
  MountConfig mount{};  // its z is that of the lasers, on the average
  Rotation turn{};
  double length_m = 0;
  geometry::Grid grid{};

  // The unit of an EndCoordinate.
  [[nodiscard]] double units_per_metre() const {
    return subcells_per_metre(grid) * (1 << vehicle::kAxisFractionBits);
  }
  // Calls along() for each axis with the mount's position, measured from the grid's corner in x and
  // y.
  [[nodiscard]] Layer with_ends(auto&& along) const {
    return {.x = along(grid_x(mount.x_m, grid), 0),
            .y = along(grid_y(mount.y_m, grid), 1),
            .z = along(mount.z_m, 2)};
  }
};

EndCoordinate end_coordinate(double origin_m, const Place& place, double elevation,
                             std::size_t axis) {
  const double scale = place.units_per_metre();
  const double up = place.turn.up[axis];
  const double reach = place.length_m * numeric::cos(elevation) * scale;
  return {
      .base = numeric::round((origin_m + place.length_m * numeric::sin(elevation) * up) * scale),
      .forward = static_cast<std::int32_t>(numeric::round(reach * place.turn.forward[axis])),
      .left = static_cast<std::int32_t>(numeric::round(reach * place.turn.left[axis]))};
}

// The beams of a layer, each with its own line.
Layer layer_of(const Place& place, double elevation) {
  return place.with_ends([&](double origin_m, std::size_t axis) {
    return end_coordinate(origin_m, place, elevation, axis);
  });
}

// The same on the lines of elevation 0, above the end of which a beam passes at z + L
// tan(elevation).
Layer shared_layer_of(const Place& place, double elevation) {
  Layer layer = layer_of(place, 0);
  layer.z = {.base = numeric::round((place.mount.z_m + place.length_m * tangent(elevation)) *
                                    place.units_per_metre())};
  layer.range_share = static_cast<std::uint32_t>(
      numeric::round(numeric::cos(elevation) * (1 << numeric::kSineFractionBits)));
  return layer;
}

// The beams of a layer of a tilted mirror.
Layer fitted_layer_of(const Place& place, const FittedDirections& fit) {
  const Rotation& turn = place.turn;
  const double scale = place.units_per_metre();
  return place.with_ends([&](double origin_m, std::size_t axis) -> EndCoordinate {
    const auto reach = [&](const std::array<double, 3>& part) {
      return place.length_m *
             (part[0] * turn.forward[axis] + part[1] * turn.left[axis] + part[2] * turn.up[axis]);
    };
    return {.base = numeric::round((origin_m + reach(fit.base)) * scale),
            .forward = static_cast<std::int32_t>(numeric::round(reach(fit.forward) * scale)),
            .left = static_cast<std::int32_t>(numeric::round(reach(fit.left) * scale))};
  });
}

template <typename Decoder>
FittedDirections directions_of(std::size_t layer, double beam_tilt_deg) {
  const auto angle_of = [](std::int32_t ticks) {
    return radians(ticks * 360.0 / Decoder::kTicksPerTurn);
  };
  return fit_directions(
      angle_of(Decoder::kRightmostTicks), angle_of(Decoder::kLeftmostTicks), [&](double azimuth) {
        return tilted_elevation(radians(Decoder::kElevationsDeg[layer]), Decoder::looks_up(layer),
                                radians(beam_tilt_deg), azimuth);
      });
}

// The unit's own, or that of its format.
template <typename Decoder>
double elevation_of(const SensorConfig& config, std::size_t layer) {
  if constexpr (!Decoder::kElevationsDeg.empty()) {
    if (config.lasers.empty()) {
      return radians(Decoder::kElevationsDeg[layer]);
    }
  }
  return radians(config.lasers[layer].elevation_deg);
}

// Says of the layer whose lines it has.
void add_layer(const Layer& layer, std::size_t number, Sensor& sensor) {
  sensor.layers[number] = layer;
  const auto same_line = [&](const Layer& other) {
    return other.x == layer.x && other.y == layer.y;
  };
  const auto first = std::ranges::find_if(sensor.layers, same_line);
  sensor.layers[number].line = static_cast<std::uint8_t>(first - sensor.layers.begin());
}

template <typename Decoder>
void add_layers(const SensorConfig& config, Sensor& sensor) {
  Place place{.mount = config.mount,
              .turn = rotation_of(config.mount),
              .length_m = config.range_max_mm / 1000.0,
              .grid = sensor.grid};
  place.mount.z_m += mean_height_m(config.lasers);
  for (std::size_t i = 0; i < sensor.layer_count; ++i) {
    if constexpr (lidar::HasBeamTilt<Decoder>) {
      add_layer(fitted_layer_of(place, directions_of<Decoder>(i, config.beam_tilt_deg)), i, sensor);
    } else {
      const double elevation = elevation_of<Decoder>(config, i);
      add_layer(sensor.layers_share_lines ? shared_layer_of(place, elevation)
                                          : layer_of(place, elevation),
                i, sensor);
    }
  }
}

// A sensor that turns and is level has one line an azimuth for all layers.
template <typename Decoder>
void add_azimuths(const SensorConfig& config, Sensor& sensor) {
  if constexpr (Decoder::kTurns) {
    vehicle::derive_azimuths<Decoder>(steps_of(config, sensor.grid.cell_mm), sensor);
    sensor.layers_share_lines = config.mount.pitch_deg == 0 && config.mount.roll_deg == 0;
  } else {
    vehicle::derive_azimuths<Decoder>(Decoder::kTicksPerTurn, sensor);
  }
}

vehicle::Footprint footprint_of(const FootprintConfig& config, const geometry::Grid& grid) {
  return {.x_min = subcells(grid_x(config.x_min_m, grid), grid),
          .x_max = subcells(grid_x(config.x_max_m, grid), grid),
          .y_min = subcells(grid_y(config.y_min_m, grid), grid),
          .y_max = subcells(grid_y(config.y_max_m, grid), grid)};
}

}  // namespace

double horizontal_range_m(const lidar::Laser& laser) {
  return laser.range_m - laser.height_m * tangent(radians(laser.elevation_deg));
}

lidar::LaserCorrection correction_of(const lidar::Laser& laser, std::int32_t ticks_per_turn) {
  return {.azimuth_ticks = nearest_tick(laser.azimuth_deg, ticks_per_turn),
          .range_mm = static_cast<std::int16_t>(numeric::round(horizontal_range_m(laser) * 1000))};
}

std::uint32_t steps_of(const SensorConfig& config, std::uint16_t cell_mm) {
  std::uint32_t steps = config.azimuth_steps_per_turn;
  if (steps == 0) {
    steps = vehicle::kFewestAzimuthSteps;
    // Step times range over 2 is half a cell or less.
    while (steps < vehicle::kMostAzimuthSteps &&
           2 * numeric::kPi * config.range_max_mm > steps * static_cast<double>(cell_mm)) {
      steps *= 2;
    }
  }
  return steps;
}

bool is_whole(double number) {
  return vehicle::is_within(number, 0.0, 1e6) &&
         vehicle::is_within(number - static_cast<double>(numeric::round(number)), -1e-6, 1e-6);
}

geometry::Grid grid_of(const GridConfig& config) {
  const auto rounded = [](double value) {
    return static_cast<std::uint16_t>(
        vehicle::is_within(value, 0.0, 65'535.0) ? numeric::round(value) : 0);
  };
  const auto cells = [&](double metres) { return rounded(metres / config.cell_m); };
  const auto side = [&](double first_m, double second_m) {
    return static_cast<std::uint16_t>(std::min(cells(first_m) + cells(second_m), 65'535));
  };
  const double cell_mm = config.cell_m * 1000;
  return {.cell_mm = is_whole(cell_mm) ? rounded(cell_mm) : std::uint16_t{0},
          .columns = side(config.behind_m, config.ahead_m),
          .rows = side(config.right_m, config.left_m),
          .origin_column = cells(config.behind_m),
          .origin_row = cells(config.right_m)};
}

namespace {

window::Extent extent_of(const WindowConfig& sides, double cell_m) {
  const auto tiles = [&](const std::optional<double>& metres) {
    const double exact = metres ? *metres / cell_m / geometry::kTileSide : window::kTilesAcross;
    return static_cast<std::uint8_t>(is_whole(exact) && exact <= 255 ? numeric::round(exact) : 0);
  };
  return {.columns = tiles(sides.side_x_m), .rows = tiles(sides.side_y_m)};
}

}  // namespace

std::optional<ageing::Tables> tables_of(const EvidenceConfig& evidence) {
  if (evidence == EvidenceConfig{}) {
    return std::nullopt;
  }
  const auto ms = [&](double metres) {
    const double exact = 1000 * metres / evidence.slowest_m_s;
    return static_cast<std::uint16_t>(std::clamp<long long>(numeric::round(exact), 1, 0xFFFF));
  };
  const auto rate = [](double half_life_s) { return -numeric::log(0.5) / (1000 * half_life_s); };
  ageing::Tables tables{
      .decays =
          ageing::make_decays(rate(evidence.moving_half_life_s), rate(evidence.static_half_life_s)),
      .accumulation = {.full_ms = ms(evidence.object_m),
                       .empty_ms = ms(evidence.gap_m),
                       .specialisations_per_second = evidence.scans_per_second},
      .free = ageing::make_free_masses(1 - evidence.free_mass),
      .hit_mass = static_cast<std::int16_t>(static_cast<int>(evidence.hit_mass * 128) * 256)};
  tables.gains = ageing::make_gains_table(tables.accumulation, tables.free, tables.hit_mass);
  return tables;
}

sensor_model::ProfileConfig profile_config(const Description& car, const SensorConfig& config) {
  return {.sigma_m = config.sigma_m,
          .cell_length_m = config.precision_mm / 1000.0,
          .epsilon = car.epsilon,
          .quantisation = car.quantisation};
}

sensor_model::Arc arc_of(const Description& car, const SensorConfig& config) {
  const double ticks = config.azimuth_sigma_deg * lidar::ticks_per_turn(config.format) / 360;
  const sensor_model::ProfileConfig profile = profile_config(car, config);
  auto arc = sensor_model::arc_of(profile, static_cast<std::uint16_t>(numeric::round(ticks)));
  arc.free = lidar::facts_of(config.format).is_ultrasonic ? sensor_model::unheard(profile)
                                                          : index::kUnknown;
  return arc;
}

Sensor numbers_of(const SensorConfig& config) {
  Sensor sensor;
  sensor.name = config.name;
  sensor.format = config.format;
  sensor.source_ipv4 = config.source_ipv4;
  sensor.udp_port = config.udp_port;
  // A range that is too long stays that.
  sensor.range = traversal::LineLength(
      std::clamp<std::uint32_t>(config.range_max_mm, 1, car_block::kLongestRangeMm + 1));
  sensor.range_min_mm = config.range_min_mm;
  sensor.precision_mm = config.precision_mm;
  sensor.no_return_clears_mm = config.no_return_clears_mm;
  sensor.scan_width_ticks = config.scan_width_ticks;
  sensor.max_points_per_scan = config.max_points_per_scan;
  if (config.ground) {
    sensor.ground = {.low_mm = millimetres(config.ground->low_m),
                     .top_mm = millimetres(config.ground->top_m)};
  }
  if (config.moved) {
    sensor.moved = {.low_mm = millimetres(config.moved->low_m),
                    .tall_mm = millimetres(config.moved->tall_m)};
  }
  sensor.is_synchronised = config.is_synchronised;
  sensor.latency_us = config.latency_us;
  const std::size_t layers =
      config.lasers.empty() ? lidar::facts_of(config.format).layers : config.lasers.size();
  sensor.layer_count = static_cast<std::uint8_t>(std::min<std::size_t>(layers, UINT8_MAX));
  sensor.is_calibrated = !config.lasers.empty() && !lidar::facts_of(config.format).is_points;
  if (config.mode.is_valid()) {
    sensor.columns_per_turn = config.mode.columns_per_turn;
    sensor.column_ns = config.mode.column_ns();
  }
  return sensor;
}

Vehicle numbers_of(const Description& car, std::span<const Sensor> sensors) {
  perception::Rules window = car.window;
  window.extent = extent_of(car.window_sides, car.grid.cell_m);
  return {.name = car.name,
          .sensors = sensors,
          .grid = grid_of(car.grid),
          .rule = car.rule,
          .quantisation = car.quantisation,
          .epsilon_e5 = hundred_thousandths(car.epsilon),
          .frame_period_us = car.frame_period_us,
          .grids = car.grids,
          .has_objects = vehicle::have_classes(car.grids) && car.objects,
          .poses = car.poses,
          .maps = car.maps,
          .window = window};
}

Sensor sensor_of(const SensorConfig& config, const Description& car) {
  Sensor sensor = numbers_of(config);
  const geometry::Grid grid = grid_of(car.grid);
  sensor.grid = grid;
  sensor.origin = {subcells(grid_x(config.mount.x_m, grid), grid),
                   subcells(grid_y(config.mount.y_m, grid), grid)};
  sensor.origin_z = subcells(config.mount.z_m + mean_height_m(config.lasers), grid);
  sensor.profile = *sensor_model::profile_of(profile_config(car, config));
  if (lidar::facts_of(config.format).marks_arcs()) {
    sensor.arc = arc_of(car, config);
  }
  vehicle::derive_limits(footprint_of(car.footprint, grid), subcells(car.z_min_m, grid),
                         subcells(car.z_max_m, grid), sensor);
  lidar::with_decoder(config.format, [&]<typename Decoder>(std::type_identity<Decoder> /*which*/) {
    add_azimuths<Decoder>(config, sensor);
    add_layers<Decoder>(config, sensor);
    std::ranges::transform(
        config.lasers, sensor.laser_corrections.begin(),
        [](const lidar::Laser& laser) { return correction_of(laser, Decoder::kTicksPerTurn); });
    if constexpr (lidar::IsPoints<Decoder>) {
      std::ranges::transform(
          config.lasers, sensor.elevations.begin(), [](const lidar::Laser& laser) {
            return static_cast<std::int32_t>(numeric::round(laser.elevation_deg * 3'200));
          });
    }
  });
  return sensor;
}

Vehicle vehicle_of(const Description& car, std::span<const Sensor> sensors) {
  Vehicle vehicle = numbers_of(car, sensors);
  vehicle.footprint = footprint_of(car.footprint, vehicle.grid);
  vehicle.z_min = subcells(car.z_min_m, vehicle.grid);
  vehicle.z_max = subcells(car.z_max_m, vehicle.grid);
  vehicle::derive_rules(sensors, vehicle.window, vehicle.grid.cell_mm);
  vehicle.id = car_block::identity_of(vehicle);
  return vehicle;
}

}  // namespace iog::description
