// What follows from a sensor's own members and is kept because the loops want it: reciprocals,
// sines, and where the car and the height band are along its lines. Integers only: the PC does it
// for a description, the target for the car of its image.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <type_traits>

#include "lidar/formats.hpp"
#include "numeric/sine_table.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::vehicle {

// Of the steps of a turn that a description may ask for.
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

// low and high: the limits of an axis in subcells, origin within 2^29 of them; length < 2^18.
constexpr RangeProducts range_products(std::int32_t low, std::int32_t high, std::int32_t origin,
                                       std::uint32_t length_mm) {
  return {.low = (std::int64_t{low} - origin) * length_mm,
          .high = (std::int64_t{high} - origin) * length_mm};
}

// Whether it is higher than the beams that open ground.
constexpr bool looks_over_things(const Sensor& sensor) {
  return sensor.moved.are_given() && sensor.origin_z > subcells_of(sensor.moved.low_mm);
}

// Sensor::share_over_ground.
constexpr std::uint32_t share_over_ground(std::int32_t z_min, std::int32_t origin_z) {
  constexpr std::int64_t kWhole = std::int64_t{1} << numeric::kSineFractionBits;
  return static_cast<std::uint32_t>(
      z_min <= 0 || origin_z <= z_min ? kWhole : (origin_z - z_min) * kWhole / origin_z);
}

}  // namespace derived_detail

// The ticks of a sensor whose azimuths stand still are its steps. One that turns never sees an
// azimuth again: its points are rounded to steps, 256 ... 16384 in powers of two.
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

// footprint and band: of its car, in subcells.
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
  sensor.tall = range_products(tall_mm == 0 ? z_min : subcells_of(tall_mm), z_max, sensor.origin_z,
                               length_mm);
}

// Ground is opened only from below if one of the sensors says how low and how tall. They look over
// things if one of those is higher than that; what is tall counts farther if one follows the
// ground.
constexpr void derive_rules(std::span<const Sensor> sensors, perception::Rules& rules) {
  rules.is_opened_from_below =
      std::ranges::any_of(sensors, [](const Sensor& sensor) { return sensor.moved.are_given(); });
  const bool is_over_ground = std::ranges::any_of(sensors, [](const Sensor& sensor) {
    return sensor.moved.tall_mm != 0 && sensor.ground.is_followed();
  });
  rules.looks_over_things = std::ranges::any_of(sensors, derived_detail::looks_over_things);
  rules.tall_within = is_over_ground ? perception::kTallOverGroundWithin : perception::kTallWithin;
}

}  // namespace iog::vehicle
