#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>

#include "car_block/limits.hpp"
#include "grid/pending_marks.hpp"

namespace iog::car_block {
namespace {

using vehicle::is_within;
using vehicle::Sensor;
using vehicle::Tell;
using vehicle::Vehicle;

constexpr std::string_view kBoxWords = "a car within the grid around its origin";

constexpr std::int64_t kUnit = std::int64_t{1} << vehicle::kAxisFractionBits;

// The highest coordinate of the plane.
constexpr std::int32_t farthest(const geometry::Grid& grid) {
  return grid.subcells(kFarthestM * 1000);
}

// The car must be within 512 cells of its origin, even if the grid covers only part of that area.
void check_box(const Vehicle& car, const Tell& tell) {
  const vehicle::Footprint& footprint = car.footprint;
  const auto is_around = [](std::int32_t low, std::int32_t high, std::int32_t origin_cell) {
    constexpr std::int32_t kHalf = geometry::kOriginCell;
    return low >= (origin_cell - kHalf) * geometry::kResolution && low <= high &&
           high <= (origin_cell + kHalf) * geometry::kResolution;
  };
  if (!is_around(footprint.x_min, footprint.x_max, car.grid.origin_column)) {
    tell({.field = "footprint.x_max_m", .allowed = kBoxWords});
  }
  if (!is_around(footprint.y_min, footprint.y_max, car.grid.origin_row)) {
    tell({.field = "footprint.y_max_m", .allowed = kBoxWords});
  }
  const std::int32_t most = farthest(car.grid);
  if (!is_within(car.z_min, -most, most) || car.z_min >= car.z_max || car.z_max > most) {
    tell({.field = "z_min_m", .allowed = "-1000 ... less than z_max_m, at most 1000"});
  }
}

void check_place(const vehicle::Footprint& footprint, const Sensor& sensor, std::size_t number,
                 const Tell& tell) {
  const std::int32_t off_car = sensor.grid.subcells(kOffCarMm) + 1;  // for rounding
  const auto is_on = [&](std::int64_t at, std::int64_t low, std::int64_t high) {
    return is_within(at, low - off_car, high + off_car);
  };
  if (!is_on(sensor.origin.x, footprint.x_min, footprint.x_max)) {
    tell({number, "mount.x_m", "a place on the car: footprint.x_min_m ... x_max_m, 0.15 off"});
  }
  if (!is_on(sensor.origin.y, footprint.y_min, footprint.y_max)) {
    tell({number, "mount.y_m", "a place on the car: footprint.y_min_m ... y_max_m, 0.15 off"});
  }
  if (!is_within(sensor.origin_z, -farthest(sensor.grid), farthest(sensor.grid))) {
    tell({number, "mount.z_m", "-1000 ... 1000"});
  }
}

// True if a laser's corrections are at most a twelfth of a turn and 10 m either way, as in
// tools/car/limits.cpp.
bool is_within_reach(const lidar::LaserCorrection& laser, std::int32_t ticks_per_turn) {
  return is_within<std::int32_t>(laser.azimuth_ticks, -ticks_per_turn / 12, ticks_per_turn / 12) &&
         is_within<std::int32_t>(laser.range_mm, -10'000, 10'000);
}

// Elevations of a unit of points must ascend.
constexpr std::int32_t kSteepest = 89 * 3'200;

void check_lasers(const Sensor& sensor, std::size_t number, const Tell& tell) {
  const std::int32_t ticks_per_turn = lidar::ticks_per_turn(sensor.format);
  if (!std::ranges::all_of(sensor.unit().corrections, [&](const lidar::LaserCorrection& laser) {
        return is_within_reach(laser, ticks_per_turn);
      })) {
    tell({number, "lasers", "azimuths of a twelfth of a turn, ranges of 10 m"});
  }
  if (lidar::facts_of(sensor.format).is_points) {
    const auto elevations = sensor.unit().elevations;
    if (sensor.is_calibrated || !is_within(elevations.front(), -kSteepest, kSteepest) ||
        !is_within(elevations.back(), -kSteepest, kSteepest) ||
        std::ranges::adjacent_find(elevations, std::greater_equal<>()) != elevations.end()) {
      tell({number, "lasers", kLayerWords});
    }
  }
}

// A vector from a layer's beam ends, in 2^-10 subcells.
struct Vector {
  std::int64_t x = 0;
  std::int64_t y = 0;
  std::int64_t z = 0;

  [[nodiscard]] bool is_within(std::int64_t most) const {
    return vehicle::is_within(x, -most, most) && vehicle::is_within(y, -most, most) &&
           vehicle::is_within(z, -most, most);
  }
  // Components are below 2^31, so the sum is below 2^64.
  [[nodiscard]] std::uint64_t square() const {
    return static_cast<std::uint64_t>(x * x) + static_cast<std::uint64_t>(y * y) +
           static_cast<std::uint64_t>(z * z);
  }
};

// Components are below 2^30.6 (walk_fits()), so three products stay below 2^63.
std::int64_t product(const Vector& a, const Vector& b) { return a.x * b.x + a.y * b.y + a.z * b.z; }

// True if start + up + forward cos a + left sin a is a beam of at most this length for every a. A
// rotation makes the three vectors orthogonal, and makes the sum of `up` with either of the others
// as long as the beam. They are rounded to 1 unit, `up` to a subcell of kUnit. The end is therefore
// within 6 subcells of its length.
//
// The vectors of a tilted mirror are fitted and not quite orthogonal. Their squares may belong to a
// length that is longer by 1 / 128, and their products may reach 1 / 512 of its square. The square
// of an end is then at most 1 + 5 / 512 times the square of this length, so the end is within
// longest_line_mm().
bool are_beams(const Vector& forward, const Vector& left, const Vector& up, const Sensor& sensor) {
  const bool is_fitted = lidar::facts_of(sensor.format).has_beam_tilt;
  const std::uint32_t range_mm = sensor.range.mm();
  const std::uint32_t length_mm = is_fitted ? range_mm + range_mm / 128 : range_mm;
  const auto length = static_cast<std::int64_t>(subcells_up(length_mm, sensor.grid) + 2) * kUnit;
  if (!forward.is_within(length) || !left.is_within(length) || !up.is_within(length)) {
    return false;
  }
  const auto most = static_cast<std::uint64_t>(length) * static_cast<std::uint64_t>(length);
  const std::int64_t askew = is_fitted ? length * (length / 512) : length * kUnit;
  const auto is_right = [&](const Vector& a, const Vector& b) {
    return vehicle::is_within(product(a, b), -askew, askew);
  };
  return forward.square() + up.square() <= most && left.square() + up.square() <= most &&
         is_right(forward, left) && is_right(forward, up) && is_right(left, up);
}

// The limit is beyond any end of a beam, and far below an overflow of differences.
bool is_near(const vehicle::EndCoordinate& end) {
  constexpr std::int64_t kFar = std::int64_t{1} << 48;
  return is_within(end.base, -kFar, kFar);
}

bool is_sound(const Sensor& sensor, const vehicle::Layer& layer) {
  if (!is_near(layer.x) || !is_near(layer.y) || !is_near(layer.z)) {
    return false;
  }
  const bool shares = sensor.layers_share_lines;
  const std::int64_t up_z = layer.z.base - sensor.origin_z * kUnit;
  const Vector forward{layer.x.forward, layer.y.forward, shares ? 0 : layer.z.forward};
  const Vector left{layer.x.left, layer.y.left, shares ? 0 : layer.z.left};
  const Vector up{layer.x.base - sensor.origin.x * kUnit, layer.y.base - sensor.origin.y * kUnit,
                  shares ? 0 : up_z};
  if (!are_beams(forward, left, up, sensor)) {
    return false;
  }
  constexpr std::uint32_t kWhole = std::uint32_t{1} << numeric::kSineFractionBits;
  if (!shares) {
    return layer.range_share == kWhole;
  }
  // The tangent of an elevation of 89 degrees is below 58.
  const auto most =
      static_cast<std::int64_t>(subcells_up(sensor.range.mm(), sensor.grid)) * 58 * kUnit;
  return is_within(up_z, -most, most) && layer.z.forward == 0 && layer.z.left == 0 &&
         is_within<std::uint32_t>(layer.range_share, 1, kWhole);
}

// An angular cell spans at most 1 degree, or 20 degrees for a cone, and its middle has an index.
// Other sensors have no arc.
void check_arc(const Sensor& sensor, std::size_t number, const Tell& tell) {
  const sensor_model::Arc& arc = sensor.arc;
  const lidar::ScannerFacts facts = lidar::facts_of(sensor.format);
  const std::uint32_t most_deg = facts.is_ultrasonic ? 20 : 1;
  if (!facts.marks_arcs()
          ? arc != sensor_model::Arc{}
          : arc.cell_ticks > most_deg * facts.ticks_per_turn / 360 || !arc.is_valid()) {
    tell({number, "azimuth_sigma_deg", kArcWords});
  }
}

// Returns true if all layers are beams, which further checks require.
bool check_layers(const Sensor& sensor, std::size_t number, const Tell& tell) {
  const auto layers = std::span(sensor.layers).first(sensor.layer_count);
  bool are_sound = true;
  if (sensor.layers_share_lines && !lidar::facts_of(sensor.format).turns) {
    tell({number, "type", "a scanner that turns, because its layers share lines"});
  }
  for (std::size_t i = 0; i < layers.size(); ++i) {
    if (!is_sound(sensor, layers[i])) {
      tell({number, "mount", "a rotation, whose beams are as long as range_max_mm"});
      are_sound = false;
    }
    const vehicle::Layer& first = layers[std::min<std::size_t>(layers[i].line, i)];
    if (layers[i].line > i || first.x != layers[i].x || first.y != layers[i].y) {
      tell({number, "type", "layers that say rightly whose lines they share"});
    }
  }
  return are_sound;
}

// A beam is tracked from its sensor, so the sensor's height must be between the ground limits.
void check_ground(const Sensor& sensor, std::size_t number, const Tell& tell) {
  const std::int32_t low_mm = sensor.ground.low_mm;
  const std::int32_t top_mm = sensor.ground.top_mm;
  if (!lidar::facts_of(sensor.format).turns) {
    tell({number, "ground", "none, because this scanner does not turn"});
  } else if (!is_within<std::int32_t>(low_mm, 100, 1'000)) {
    tell({number, "ground.low_m", kGroundLowWords});
  } else if (!is_within<std::int32_t>(top_mm, low_mm + 500, 10'000)) {
    tell({number, "ground.top_m", kGroundTopWords});
  } else if (sensor.origin_z <= sensor.grid.subcells(sensor.ground.low_mm)) {
    tell({number, "ground.low_m", "less than mount.z_m, the sensor's own height"});
  } else if (sensor.origin_z >= sensor.grid.subcells(sensor.ground.top_mm)) {
    tell({number, "ground.top_m",
          "more than mount.z_m, the sensor's own height: write ground = { top_m = ... }"});
  }
}

// Both limits must be heights at which a return is an obstacle.
void check_moved(const Vehicle& car, std::size_t number, const Tell& tell) {
  const Sensor& sensor = car.sensors[number];
  const vehicle::MovedLimits& moved = sensor.moved;
  const bool follows = sensor.ground.is_followed();
  const std::int32_t begin =
      follows
          ? sensor.grid.subcells(std::max(sensor.ground.low_mm, vehicle::MovedLimits::kUnderCarsMm))
          : car.z_min;
  const std::int32_t end = follows ? sensor.grid.subcells(sensor.ground.top_mm) : car.z_max;
  if (moved.low_mm > 10'000 ||
      sensor.grid.subcells(moved.low_mm) < begin + sensor.grid.subcells(100)) {
    tell({number, "moved.low_m", kMovedLowWords});
  } else if (sensor.grid.subcells(moved.tall_mm) > end) {
    tell({number, "moved.tall_m", kMovedTallWords});
  }
}

// Each sensor that follows the ground needs a ground surface.
void check_grounds(std::span<const Sensor> sensors, const Tell& tell) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    if (sensors[i].ground.is_followed()) {
      check_ground(sensors[i], i, tell);
      ++count;
      if (count > vehicle::kMaxGroundSensors) {
        tell({i, "ground", "none, because two sensors of a car follow the ground at most"});
      }
    }
  }
}

// Level rotating sensors cache their lines.
void check_lines(std::span<const Sensor> sensors, const Tell& tell) {
  std::size_t lines = 0;
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    lines += sensors[i].layers_share_lines ? sensors[i].azimuths.steps_per_turn() : 0;
    if (lines > vehicle::kMaxTurnLines) {
      tell({i, "azimuth_steps_per_turn",
            "fewer: level sensors that turn have 8192 lines together, one for each step"});
      return;
    }
  }
}

// True if any beam of the layer, from the sensor to the end of its range, enters the band.
bool meets_band(const Sensor& sensor, const vehicle::Layer& layer, std::int64_t z_min,
                std::int64_t z_max) {
  const auto size_of = [](std::int64_t value) { return value < 0 ? -value : value; };
  const std::int64_t swing = size_of(layer.z.forward) + size_of(layer.z.left);
  const std::int64_t origin = sensor.origin_z * kUnit;
  return std::max(origin, layer.z.base + swing) >= z_min * kUnit &&
         std::min(origin, layer.z.base - swing) <= z_max * kUnit;
}

void check_band(const Vehicle& car, std::size_t number, const Tell& tell) {
  const Sensor& sensor = car.sensors[number];
  const auto layers = std::span(sensor.layers).first(sensor.layer_count);
  if (std::ranges::none_of(layers, [&](const vehicle::Layer& layer) {
        return meets_band(sensor, layer, car.z_min, car.z_max);
      })) {
    tell({number, "mount.z_m", "a height and tilt of which some beam meets z_min_m ... z_max_m"});
  }
}

// Limits the cells that all sensors together mark in a frame.
void check_marks(std::span<const Sensor> sensors, const Tell& tell) {
  const auto marks_of = [](const Sensor& sensor) {
    return std::uint64_t{sensor.max_points_per_scan} * grid::max_marks_per_point(sensor);
  };
  std::uint64_t marks = 0;
  std::size_t first_beyond = sensors.size();
  for (std::size_t i = 0; i < sensors.size(); ++i) {
    marks += marks_of(sensors[i]);
    if (marks > grid::kMaxMarks) {
      first_beyond = std::min(first_beyond, i);
    }
  }
  if (first_beyond < sensors.size()) {
    tell({.sensor = first_beyond,
          .field = "max_points_per_scan",
          .allowed = "fewer: all sensors together mark at most 262144 cells a frame",
          .sum = marks});
  }
}

}  // namespace

void check_tables(const Vehicle& car, const Tell& tell) {
  check_box(car, tell);
  for (std::size_t i = 0; i < car.sensors.size(); ++i) {
    const Sensor& sensor = car.sensors[i];
    check_place(car.footprint, sensor, i, tell);
    if (!sensor.profile.is_valid()) {
      tell({i, "precision_mm", "1 ... 1000, with which the sensor can mark"});
    }
    check_lasers(sensor, i, tell);
    check_arc(sensor, i, tell);
    if (check_layers(sensor, i, tell)) {
      check_band(car, i, tell);
    }
    if (car.sensors[i].moved.are_given()) {
      check_moved(car, i, tell);
    }
  }
  check_grounds(car.sensors, tell);
  check_lines(car.sensors, tell);
  check_marks(car.sensors, tell);
}

}  // namespace iog::car_block
