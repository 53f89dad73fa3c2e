// Classes and the pose as messages of ROS 2, serialised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "tools/formats/ros/grid_messages.hpp"
#include "tools/frames/class_grid.hpp"
#include "tools/frames/live_classes.hpp"

namespace iog::tools::ros {

// The local frame of whoever sends the poses: smooth, as ROS wants its odom (REP 105).
inline constexpr std::string_view kLocalFrameId = "odom";

// nav_msgs/msg/OccupancyGrid in the local frame; -1 where the class is unknown or the tile is
// missing, else a value for each class: below 20 free, above 65 occupied, as map_server draws the
// line. They are in docs/recordings.md. Something of the classes has arrived (has_window()).
[[nodiscard]] std::vector<std::byte> class_occupancy_grid(const ClassGrid& classes,
                                                          std::uint64_t stamp_us);
[[nodiscard]] std::int8_t percent_of_class(std::int8_t class_byte);

// foxglove_msgs/msg/Grid in the local frame, three bytes a cell: `class` and `sureness`, uint8
// (docs/spec.md 3.9); `age_frames`, uint8: frames since the tile was decided, 254 that many or
// more, 255 the tile is missing. The window is known.
[[nodiscard]] std::vector<std::byte> foxglove_class_grid(const LiveClasses& classes,
                                                         std::uint64_t stamp_us);

// tf2_msgs/msg/TFMessage: the vehicle frame in the local frame.
[[nodiscard]] std::vector<std::byte> transform_of(const pose::Pose& pose, std::uint64_t stamp_us);

}  // namespace iog::tools::ros
