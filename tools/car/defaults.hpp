// What the file of a car need not say, because its units decide it (docs/vehicles.md).
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>

#include "tools/car/description.hpp"

namespace iog::description {

// The UDP port to which a unit of this type sends as it comes from its maker.
[[nodiscard]] std::uint16_t usual_port(std::string_view type);

// Where obstacles end: a car is as high as what is mounted on it.
[[nodiscard]] double top_m_over(double mount_z_m);

// Where the height band begins if the car file does not say it.
inline constexpr double kUsualZMinM = 0.30;

// Of a unit that reaches so far: as far as its beams may be in the cells of the car's grid
// (car_block/limits.hpp).
[[nodiscard]] std::uint32_t usual_range_max_mm(const SensorConfig& sensor, std::uint16_t cell_mm);

// A unit that turns follows the ground, unless it is too low to see much of it.
[[nodiscard]] std::optional<GroundConfig> usual_ground(const SensorConfig& sensor);

// Over the ground that is followed, or over the car's plane.
[[nodiscard]] MovedConfig usual_moved(const std::optional<GroundConfig>& ground);

// Both, where classes are possible: without a radar or an ultrasonic unit, by hits_win and
// blurring.
[[nodiscard]] vehicle::Grids usual_grids(const Description& car,
                                         std::span<const SensorConfig> sensors);

// Of a unit that turns: by its mode or, if its format has none, at 10 Hz.
[[nodiscard]] std::uint32_t usual_turn_us(const SensorConfig& sensor);

// 40 ms, a scan of a LUX. If all lidars spin, 1.5 turns, so that a whole turn ends its frame
// itself. A car with classes and a unit of 40 layers or more has 40 ms, too: a turn of such a unit
// hits more cells than the tracker has room for (objects::kMostHits), so distant cars would not be
// tracked. Four cores cannot fuse a VLS-128 so often.
[[nodiscard]] std::uint32_t usual_frame_period_us(std::span<const SensorConfig> sensors,
                                                  vehicle::Grids grids);

// Level units that turn share the lines of a car: those whose steps the file does not say get as
// many as fit.
void share_turn_lines(std::span<SensorConfig> sensors, std::uint16_t cell_mm);

}  // namespace iog::description
