// Where a car's sensors are, as a message of ROS 2, serialised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/car/description.hpp"

namespace iog::tools::ros {

// tf2_msgs/msg/TFMessage: each sensor, by its name, in the vehicle frame: x as the unit looks, y
// left, z up.
[[nodiscard]] std::vector<std::byte> mounts_of(std::span<const description::SensorConfig> sensors,
                                               std::uint64_t stamp_us);

}  // namespace iog::tools::ros
