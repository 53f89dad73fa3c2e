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

// A unit that turns follows the ground, unless it is too low to see much of it.
[[nodiscard]] std::optional<GroundConfig> usual_ground(const SensorConfig& sensor);

// Over the ground that is followed, or over the car's plane.
[[nodiscard]] MovedConfig usual_moved(const std::optional<GroundConfig>& ground);

// Both, where classes are possible: without a radar or an ultrasonic unit, by hits_win and
// blurring.
[[nodiscard]] vehicle::Grids usual_grids(const Description& car,
                                         std::span<const SensorConfig> sensors);

// A scan of a LUX; a turn and half of another if all lidars turn, so that a whole turn ends its
// frame itself.
[[nodiscard]] std::uint32_t usual_frame_period_us(std::span<const SensorConfig> sensors);

// Level units that turn share the lines of a car: those whose steps the file does not say get as
// many as fit.
void share_turn_lines(std::span<SensorConfig> sensors);

}  // namespace iog::description
