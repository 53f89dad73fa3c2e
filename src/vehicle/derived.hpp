// Derives some members of a sensor from its other members. The derived members, which are used in
// loops, are reciprocals, sines, and the extents of the car and the height band along the sensor's
// lines. The code uses only integers, and runs on the PC when a car file is read and on the target
// when the car block is read.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "geometry/sizes.hpp"
#include "lidar/formats.hpp"
#include "numeric/magnitude.hpp"
#include "numeric/sine_table.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicle {

// The limits of azimuth_steps_per_turn in a car file.
inline constexpr std::uint32_t kFewestAzimuthSteps = 256;
inline constexpr std::uint32_t kMostAzimuthSteps = 16384;

namespace derived_detail {

constexpr numeric::SineTable sines_of(std::uint32_t steps_per_turn) {
  switch (steps_per_turn) {
    case 256:
      return numeric::kSineTable<256>;
    case 512:
      return numeric::kSineTable<512>;
    case 1024:
      return numeric::kSineTable<1024>;
    case 2048:
      return numeric::kSineTable<2048>;
    case 4096:
      return numeric::kSineTable<4096>;
    case 8192:
      return numeric::kSineTable<8192>;
    default:  // 16384
      return numeric::kSineTable<16384>;
  }
}

// `low` and `high` are limits along an axis in subcells. The origin must be within 2^29 subcells of
// both limits. Requires length_mm < 2^18.
constexpr RangeProducts range_products(std::int32_t low, std::int32_t high, std::int32_t origin,
                                       std::uint32_t length_mm) {
  return {.low = (std::int64_t{low} - origin) * length_mm,
          .high = (std::int64_t{high} - origin) * length_mm};
}

// Returns true if the sensor is mounted above its own limit for low beams.
constexpr bool looks_over_things(const Sensor& sensor) {
  return sensor.moved.are_given() && sensor.origin_z > sensor.grid.subcells(sensor.moved.low_mm);
}

// Returns the distance from the vehicle's reference point within which all beams of a level sensor
// are higher than the limit for low beams. A layer's beams end, on average, at the height z.base.
constexpr std::int32_t blind_mm(const Sensor& sensor) {
  if (!looks_over_things(sensor)) {
    return 0;
  }
  const auto layers = std::span(sensor.layers).first(sensor.layer_count);
  const std::int64_t lowest =
      std::ranges::min(layers, {}, [](const Layer& layer) { return layer.z.base; }).z.base >>
      kAxisFractionBits;
  const std::int64_t drop = sensor.origin_z - lowest;
  const std::int64_t height = sensor.origin_z - sensor.grid.subcells(sensor.moved.low_mm);
  const std::int64_t range_mm = sensor.range.mm();
  const std::int64_t out_mm = height >= drop ? range_mm : height * range_mm / drop;
  const auto aside = [](std::int32_t at, std::int32_t origin_cell) {
    return std::int64_t{numeric::magnitude(at - origin_cell * geometry::kResolution)};
  };
  const std::int64_t off = aside(sensor.origin.x, sensor.grid.origin_column) +
                           aside(sensor.origin.y, sensor.grid.origin_row);
  const std::int64_t off_mm = off * sensor.grid.cell_mm / geometry::kResolution;
  return static_cast<std::int32_t>(std::max<std::int64_t>(out_mm - off_mm, 0));
}

// Returns the value of Sensor::share_over_ground.
constexpr std::uint32_t share_over_ground(std::int32_t z_min, std::int32_t origin_z) {
  constexpr std::int64_t kWhole = std::int64_t{1} << numeric::kSineFractionBits;
  return static_cast<std::uint32_t>(
      z_min <= 0 || origin_z <= z_min ? kWhole : (origin_z - z_min) * kWhole / origin_z);
}

}  // namespace derived_detail

// If a sensor has fixed azimuths, its ticks are used as steps. A rotating sensor never repeats an
// azimuth exactly, so its azimuths are rounded to steps. The number of steps per turn is a power of
// two from 256 to 16384.
template <typename Decoder>
constexpr void derive_azimuths(std::uint32_t steps_per_turn, Sensor& sensor) {
  if constexpr (Decoder::kTurns) {
    sensor.sines = derived_detail::sines_of(steps_per_turn);
    sensor.azimuths = AzimuthSteps(Decoder::kTicksPerTurn, steps_per_turn);
  } else {
    sensor.sines = numeric::kSineTable<Decoder::kTicksPerTurn>;
    sensor.azimuths = AzimuthSteps(Decoder::kTicksPerTurn, Decoder::kTicksPerTurn);
  }
}

// The arguments are the footprint and the height band of the car, in subcells. Sensor::grid must be
// the car's grid.
constexpr void derive_limits(const Footprint& footprint, std::int32_t z_min, std::int32_t z_max,
                             Sensor& sensor) {
  using derived_detail::range_products;
  const std::uint32_t length_mm = sensor.range.mm();
  sensor.precision = numeric::Reciprocal(sensor.precision_mm);
  sensor.on_car_x = range_products(footprint.x_min, footprint.x_max, sensor.origin.x, length_mm);
  sensor.on_car_y = range_products(footprint.y_min, footprint.y_max, sensor.origin.y, length_mm);
  sensor.in_band = range_products(z_min, z_max, sensor.origin_z, length_mm);
  sensor.share_over_ground = derived_detail::share_over_ground(
      derived_detail::looks_over_things(sensor) ? 0 : z_min, sensor.origin_z);
  const std::uint16_t tall_mm = sensor.moved.tall_mm;
  sensor.tall = range_products(tall_mm == 0 ? z_min : sensor.grid.subcells(tall_mm), z_max,
                               sensor.origin_z, length_mm);
}

// If any sensor specifies MovedLimits, enables free-space gating. If one of these sensors is
// mounted above its limit for low beams, sets `looks_over_things`. If a sensor with a limit for
// tall returns follows the ground, increases `tall_within`, the maximum distance from a hit to a
// tall return. Sets `blind_mm` to the smallest distance of any sensor. Converts lengths to cells.
constexpr void derive_rules(std::span<const Sensor> sensors, perception::Rules& rules,
                            int cell_mm = geometry::kCellMm) {
  rules.is_opened_from_below =
      std::ranges::any_of(sensors, [](const Sensor& sensor) { return sensor.moved.are_given(); });
  const bool is_over_ground = std::ranges::any_of(sensors, [](const Sensor& sensor) {
    return sensor.moved.tall_mm != 0 && sensor.ground.is_followed();
  });
  rules.looks_over_things = std::ranges::any_of(sensors, derived_detail::looks_over_things);
  rules.blind_mm = sensors.empty() ? 0
                                   : derived_detail::blind_mm(*std::ranges::min_element(
                                         sensors, {}, derived_detail::blind_mm));
  rules.tall_within = perception::cells_of(
      is_over_ground ? perception::kTallOverGroundWithinMm : perception::kTallWithinMm, cell_mm);
  rules.around = perception::around_with(cell_mm);
}

}  // namespace iog::vehicle
