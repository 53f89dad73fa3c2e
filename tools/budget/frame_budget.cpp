#include "tools/budget/frame_budget.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <span>

#include "geometry/grid.hpp"
#include "grid/cone.hpp"
#include "grid/pending_marks.hpp"
#include "lidar/formats.hpp"
#include "tools/budget/unit_costs.hpp"
#include "tools/formats/lux/lux_scan.hpp"
#include "tools/vehicles/two_returns.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::tools {
namespace {

constexpr double kTurnMs = 100;  // at 10 Hz

// Reckoned of its code, not measured: six products of two words, and a byte.
constexpr double kConeCellCycles = 30;

// Modelled once, of a VLP-16 pitched by 3 degrees and an HDL-32E by -2 (docs/a9_model.md has the
// model, nominal variant): 3116 and 2976 a point, with 64-bit divisions at the rate of the rest.
constexpr double kTiltedPointCycles = 3050;

double ms_of(double cycles) { return cycles * kMsPerCycle; }

// Its azimuths never repeat, but lines of all its azimuth steps are kept.
bool is_level(const vehicle::Sensor& sensor) { return sensor.layers_share_lines; }

bool has_unit_that_turns(const CatalogueEntry& car) {
  return std::ranges::any_of(car.sensors, lidar::turns, &description::SensorConfig::format);
}

// A LUX fires into the same directions in each scan. The others' heads turn as they like.
bool repeats(const description::SensorConfig& sensor) { return sends_lux_scans(sensor.format); }

// Echoes that a description allows a direction: those of a LUX, and two returns of a unit that has
// them, if a scan may hold both.
double echoes_of(const description::SensorConfig& sensor) {
  if (repeats(sensor)) {
    return 3;
  }
  if (sends_two_returns(sensor.format)) {
    return 2;
  }
  const std::uint32_t points = points_with_two_returns(sensor.format);
  return points > 0 && points <= sensor.max_points_per_scan ? 2 : 1;
}

// How far a layer's beams stay in the height band, and within the sensor's range, in metres; ahead,
// which for a level sensor is everywhere.
double reach_m(const CatalogueEntry& car, std::size_t number, const vehicle::Layer& layer) {
  const double range_m = car.sensors[number].range_max_mm / 1000.0;
  const double subcells = car.vehicle->grid.subcells(1000);  // per metre
  const double begin_m = car.vehicle->sensors[number].origin_z / subcells;
  const double end_m = static_cast<double>(layer.z.base + layer.z.forward) /
                       (1 << vehicle::kAxisFractionBits) / subcells;
  const double rise = (end_m - begin_m) / range_m;
  const double room_m =
      rise < 0 ? begin_m - car.description->z_min_m : car.description->z_max_m - begin_m;
  return room_m <= 0 || rise == 0 ? range_m : std::min(range_m, room_m / std::abs(rise));
}

std::span<const vehicle::Layer> layers_of(const CatalogueEntry& car, std::size_t sensor) {
  const vehicle::Sensor& its = car.vehicle->sensors[sensor];
  return std::span(its.layers).first(its.layer_count);
}

double longest_reach_m(const CatalogueEntry& car, std::size_t sensor) {
  double longest = 0;
  for (const vehicle::Layer& layer : layers_of(car, sensor)) {
    longest = std::max(longest, reach_m(car, sensor, layer));
  }
  return longest;
}

double mean_reach_m(const CatalogueEntry& car, std::size_t sensor) {
  double sum = 0;
  for (const vehicle::Layer& layer : layers_of(car, sensor)) {
    sum += reach_m(car, sensor, layer);
  }
  return sum / static_cast<double>(layers_of(car, sensor).size());
}

// Points of a frame, an echo a direction.
double directions_of(const description::SensorConfig& sensor) {
  return sensor.max_points_per_scan / echoes_of(sensor);
}

bool sees(const CatalogueEntry& car, std::size_t sensor, double x_m, double y_m) {
  const description::MountConfig& mount = car.sensors[sensor].mount;
  const double turn = static_cast<double>(car.vehicle->sensors[sensor].sines.ticks_per_turn());
  const double half_width = 180.0 * car.sensors[sensor].scan_width_ticks / turn;
  // From a tile's middle to its corner.
  const double corner_m =
      geometry::kTileSide * car.vehicle->grid.cell_mm / 2000.0 * std::numbers::sqrt2;
  const double distance_m = std::hypot(x_m - mount.x_m, y_m - mount.y_m);
  if (distance_m <= 2 * corner_m) {
    return true;
  }
  const double bearing = std::atan2(y_m - mount.y_m, x_m - mount.x_m) * 180 / std::numbers::pi;
  const double off = std::abs(std::remainder(bearing - mount.yaw_deg, 360.0));
  const double margin = std::asin(corner_m / distance_m) * 180 / std::numbers::pi;
  return distance_m <= longest_reach_m(car, sensor) + corner_m && off <= half_width + margin;
}

// Tiles of the grid that some beam can reach.
double tiles_in_reach(const CatalogueEntry& car) {
  const geometry::Grid& grid = car.vehicle->grid;
  const double tile_m = geometry::kTileSide * grid.cell_mm / 1000.0;
  std::size_t count = 0;
  const geometry::TileRows rows(grid);
  for (std::size_t tile = 0; tile < grid.tile_count(); ++tile) {
    const auto [column, row_number] = rows.place_of(tile);
    const double x_m = (column + 0.5) * tile_m - grid.origin_column * grid.cell_mm / 1000.0;
    const double y_m = (row_number + 0.5) * tile_m - grid.origin_row * grid.cell_mm / 1000.0;
    bool is_seen = false;
    for (std::size_t sensor = 0; sensor < car.sensors.size(); ++sensor) {
      is_seen = is_seen || sees(car, sensor, x_m, y_m);
    }
    count += is_seen ? 1U : 0U;
  }
  return static_cast<double>(count);
}

// Directions, and the metres that their beams could carve.
struct Sight {
  double directions = 0;
  double metres = 0;
};

Sight sight_of(const CatalogueEntry& car) {
  Sight sight;
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    const double directions = directions_of(car.sensors[i]);
    sight.directions += directions;
    sight.metres += directions * mean_reach_m(car, i);
  }
  return sight;
}

// Of the tiles in reach as many as on the drives, of a car with a unit that turns or of one
// without.
double typical_tiles(const CatalogueEntry& car) {
  if (has_unit_that_turns(car)) {
    return kTurnTiles * tiles_in_reach(car) / tiles_in_reach(find_vehicle("roof_hdl32e"));
  }
  return kTypicalTiles * tiles_in_reach(car) / tiles_in_reach(find_vehicle(kDefaultVehicle));
}

// A unit that turns ends its frames itself, long before their time is over.
double period_ms(const CatalogueEntry& car) {
  const double most_ms = car.vehicle->frame_period_us / 1000.0;
  return has_unit_that_turns(car) ? std::min(most_ms, kTurnMs) : most_ms;
}

bool has_arcs(const vehicle::Sensor& sensor) { return sensor.arc.is_given(); }

// Of all detections of a list, so far away.
double arc_steps_at(const vehicle::Sensor& sensor, std::uint32_t range_mm) {
  const std::int32_t step = grid::arc_step_ticks(sensor, range_mm);
  const std::int32_t to_one_side = sensor.arc.reach_ticks() / step;
  return sensor.max_points_per_scan * (1.0 + 2.0 * to_one_side);
}

double cone_cells_at(const vehicle::Sensor& sensor, std::uint32_t range_mm) {
  return sensor.arc.free == 0
             ? 0.0
             : sensor.max_points_per_scan * 1.0 * grid::most_cells_of_cone(sensor.grid, range_mm);
}

void add_arcs(const vehicle::Sensor& sensor, std::uint32_t range_mm, FrameWork& work) {
  work.arc_steps += arc_steps_at(sensor, range_mm);
  work.cone_cells += cone_cells_at(sensor, range_mm);
}

void add_ground(const vehicle::Sensor& sensor, double turn, double points, FrameWork& work) {
  if (sensor.ground.is_followed()) {
    work.ground_turns += turn;
    work.ground_points += points;
  }
}

// What makes no classes keeps no heights.
bool opens_from_below(const CatalogueEntry& car) {
  return car.vehicle->window.is_opened_from_below && vehicle::have_classes(car.vehicle->grids);
}

void add_moved(const CatalogueEntry& car, const vehicle::Sensor& sensor, double points,
               FrameWork& work) {
  work.moved_frames = opens_from_below(car) ? 1 : 0;
  work.moved_points += opens_from_below(car) && sensor.moved.are_given() ? points : 0.0;
}

// Of a turn, what a frame has that may be shorter.
double share_of_turn(const CatalogueEntry& car) { return period_ms(car) / kTurnMs; }

FrameWork typical_work(const CatalogueEntry& car) {
  const CatalogueEntry& known = find_vehicle(kDefaultVehicle);
  const Sight sight = sight_of(known);
  const double share = kTypicalPoints / sight.directions;
  const double cells_per_metre = kTypicalCells / sight.metres;
  FrameWork work{.tiles = typical_tiles(car)};
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    const bool its_turn = lidar::turns(car.sensors[i].format);
    const double of_scan = its_turn ? share_of_turn(car) : 1.0;
    const double directions = of_scan * directions_of(car.sensors[i]);
    if (has_arcs(car.vehicle->sensors[i])) {
      add_arcs(car.vehicle->sensors[i], car.sensors[i].range_max_mm / 2, work);
    } else if (is_level(car.vehicle->sensors[i])) {
      work.turn_steps += of_scan * car.vehicle->sensors[i].azimuths.steps_per_turn();
      work.turn_points += directions;  // it sends all of them, with an echo or without
    } else if (repeats(car.sensors[i])) {
      work.points += share * directions;
      work.cells += cells_per_metre * directions * mean_reach_m(car, i);
    } else if (its_turn) {
      work.tilted_points += directions;
    } else {
      work.points_once += share * directions;
    }
    add_ground(car.vehicle->sensors[i], of_scan, directions, work);
    add_moved(car, car.vehicle->sensors[i], directions, work);
  }
  const double seen = tiles_in_reach(car) / tiles_in_reach(known);
  work.class_tiles = vehicle::have_classes(car.vehicle->grids) ? kTypicalClassTiles * seen : 0.0;
  return work;
}

// What is worst comes at azimuths that never came before, of any sensor.
FrameWork worst_work(const CatalogueEntry& car) {
  FrameWork work{.tiles = tiles_in_reach(car)};
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    const description::SensorConfig& sensor = car.sensors[i];
    if (has_arcs(car.vehicle->sensors[i])) {
      add_arcs(car.vehicle->sensors[i], sensor.range_max_mm, work);
      continue;
    }
    work.points_once += directions_of(sensor);
    work.later_echoes += sensor.max_points_per_scan - directions_of(sensor);
    add_ground(car.vehicle->sensors[i], 1, sensor.max_points_per_scan, work);
    add_moved(car, car.vehicle->sensors[i], sensor.max_points_per_scan, work);
  }
  const auto all_tiles = static_cast<double>(geometry::kTileCount);
  work.class_tiles = vehicle::have_classes(car.vehicle->grids) ? all_tiles : 0.0;
  return work;
}

double worst_ms(const FrameWork& work) {
  return ms_of(work.points_once * kPointOnceCycles +
               (work.later_echoes + work.arc_steps) * kLaterEchoCycles +
               work.cone_cells * kConeCellCycles + work.tiles * kDearestTileCycles +
               work.class_tiles * kDearestClassTileCycles) +
         ground_ms(work) + moved_ms(work);
}

}  // namespace

double ground_ms(const FrameWork& work) {
  return ms_of(work.ground_turns * kGroundTurnCycles + work.ground_points * kGroundPointCycles);
}

double moved_ms(const FrameWork& work) {
  return ms_of(work.moved_frames * kMovedFrameCycles + work.moved_points * kMovedPointCycles);
}

double typical_ms(const FrameWork& work) {
  return ms_of(work.points * kPointCycles + work.turn_steps * kTurnStepCycles +
               work.turn_points * kTurnPointCycles + work.points_once * kPointOnceCycles +
               work.tilted_points * kTiltedPointCycles +
               (work.later_echoes + work.arc_steps) * kLaterEchoCycles +
               work.cone_cells * kConeCellCycles + work.cells * kCellCycles +
               work.tiles * kTileCycles + work.class_tiles * kClassTileCycles) +
         ground_ms(work) + moved_ms(work);
}

VehicleBudget budget_of(const CatalogueEntry& car) {
  VehicleBudget budget{.period_ms = period_ms(car)};
  budget.typical.work = typical_work(car);
  budget.typical.ms = typical_ms(budget.typical.work);
  budget.worst.work = worst_work(car);
  budget.worst.ms = worst_ms(budget.worst.work);
  return budget;
}

std::size_t cores_for(double ms, double period_ms) {
  const auto* const found =
      std::ranges::find_if(kShareOfCores, [=](double share) { return share * ms <= period_ms; });
  return found == kShareOfCores.end()
             ? 0
             : static_cast<std::size_t>(std::distance(kShareOfCores.begin(), found)) + 1;
}

}  // namespace iog::tools
