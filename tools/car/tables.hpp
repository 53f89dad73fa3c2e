// From a description to the integers that run on a target: rounds, and computes every table. It is
// the one place where a car's numbers are floating point, and no target has it: whoever needs a car
// there reads the block that is made of this (car_block/car_block.hpp). The arithmetic is that of
// IEEE 754 in one order (compilers must not contract a * b + c), so every PC makes the same bytes.
#pragma once

#include <cstdint>
#include <span>

#include "tools/car/description.hpp"
#include "vehicle/vehicle.hpp"

namespace iog::description {

// True if a quotient of lengths is a whole number, apart from rounding errors.
[[nodiscard]] bool is_whole(double number);

// Sizes and lengths that no grid can have become 0.
[[nodiscard]] geometry::Grid grid_of(const GridConfig& config);

// Returns nothing if the constants are the defaults.
[[nodiscard]] std::optional<ageing::Tables> tables_of(const EvidenceConfig& evidence);

// What of a sensor needs no table. Of any description: what is wrong in it is told by check()
// (tools/car/limits.hpp) and car_block::check_numbers(), and only what passes both may get
// tables.
[[nodiscard]] vehicle::Sensor numbers_of(const SensorConfig& config);

// The same of a car. Names are those of the description, and sensors outlive the vehicle.
[[nodiscard]] vehicle::Vehicle numbers_of(const Description& car,
                                          std::span<const vehicle::Sensor> sensors);

// With all tables.
[[nodiscard]] vehicle::Sensor sensor_of(const SensorConfig& config, const Description& car);
[[nodiscard]] vehicle::Vehicle vehicle_of(const Description& car,
                                          std::span<const vehicle::Sensor> sensors);

// Of a sensor that turns: its steps, or the fewest, in powers of two, that are at most a cell wide
// at its range.
[[nodiscard]] std::uint32_t steps_of(const SensorConfig& config, std::uint16_t cell_mm);

// What a laser's calibration adds to each range: a beam that starts so high across itself is, seen
// from the side, one from the unit's axis. It starts height / cos over the origin, and each of its
// ranges is height * tan less.
[[nodiscard]] double horizontal_range_m(const lidar::Laser& laser);

// The part of a calibration that changes a scan point: the tick nearest to the laser's azimuth, a
// tie away from 0, and horizontal_range_m().
[[nodiscard]] lidar::LaserCorrection correction_of(const lidar::Laser& laser,
                                                   std::int32_t ticks_per_turn);

// Of a radar or an ultrasonic unit, in units of its ticks.
[[nodiscard]] sensor_model::Arc arc_of(const Description& car, const SensorConfig& config);

[[nodiscard]] sensor_model::ProfileConfig profile_config(const Description& car,
                                                         const SensorConfig& config);

}  // namespace iog::description
