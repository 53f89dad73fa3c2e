// Scan points as a message of ROS 2, serialised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "tools/vehicles/seen_point.hpp"

namespace iog::tools::ros {

// sensor_msgs/msg/PointCloud2 in the vehicle frame, a row of points of 16 bytes: `x`, `y`, `z`,
// float32, metres; `fate`, uint8, by its number (docs/spec.md 1.3). Each lies where the car was
// when it was taken.
[[nodiscard]] std::vector<std::byte> point_cloud(std::span<const SeenPoint> points,
                                                 std::uint64_t stamp_us);

}  // namespace iog::tools::ros
