// A grid as messages of ROS 2, serialised; and the definitions of these messages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "tools/frames/grid_frame.hpp"
#include "tools/frames/live_grid.hpp"

namespace iog::tools::ros {

// The vehicle frame: x forward, y left, z up, as ROS wants its base_link (REP 105, REP 103).
inline constexpr std::string_view kFrameId = "base_link";

struct MessageType {
  std::string_view name;
  std::string_view definition;  // "ros2msg": with those of the types that it is made of
};
extern const MessageType kOccupancyGrid;    // nav_msgs/msg/OccupancyGrid
extern const MessageType kImage;            // sensor_msgs/msg/Image
extern const MessageType kFoxgloveGrid;     // foxglove_msgs/msg/Grid
extern const MessageType kUint8MultiArray;  // std_msgs/msg/UInt8MultiArray
extern const MessageType kTfMessage;        // tf2_msgs/msg/TFMessage
extern const MessageType kSceneUpdate;      // foxglove_msgs/msg/SceneUpdate
extern const MessageType kMarkerArray;      // visualization_msgs/msg/MarkerArray
extern const MessageType kPointCloud;       // sensor_msgs/msg/PointCloud2

// The probability in percent of each index from -127, rounded to the nearest; a half upwards. 50 is
// that of index 0 alone, because no car's epsilon is below 0.01.
class Percents {
 public:
  static constexpr std::uint8_t kNotKnown = 50;

  // epsilon is that of the recursive set, 0.01 <= epsilon < 1/2. Without epsilon, as for a frame
  // without indexes, all percents are kNotKnown.
  explicit Percents(std::optional<double> epsilon);
  [[nodiscard]] std::uint8_t operator[](index::OccupancyIndex index) const {
    return percents_[static_cast<std::uint8_t>(index)];
  }

 private:
  std::array<std::uint8_t, 256> percents_{};  // by the index as a byte
};

// stamp_us: what header.stamp is to be.

// nav_msgs/msg/OccupancyGrid: 0 ... 100, the probability in percent; -1 where the index is 0 or the
// tile is missing.
[[nodiscard]] std::vector<std::byte> occupancy_grid(const GridFrame& frame, std::uint64_t stamp_us,
                                                    const Percents& percents);

// sensor_msgs/msg/Image, mono8, a pixel a cell, seen from above with x (forward) up: white is free,
// black is occupied, 128 is unknown or missing.
[[nodiscard]] std::vector<std::byte> image(const GridFrame& frame, std::uint64_t stamp_us,
                                           const Percents& percents);

// foxglove_msgs/msg/Grid, three bytes a cell: `index`, int8; `probability_percent`, uint8;
// `age_frames`, uint8: frames since the cell's tile arrived, 254 that many or more, 255 never.
[[nodiscard]] std::vector<std::byte> foxglove_grid(const LiveGrid& grid, std::uint64_t stamp_us,
                                                   const Percents& percents);
inline constexpr std::uint8_t kOldestAge = 254;
inline constexpr std::uint8_t kNeverArrived = 255;

// std_msgs/msg/UInt8MultiArray: bytes, without a layout.
[[nodiscard]] std::vector<std::byte> uint8_multi_array(std::span<const std::byte> bytes);

// Such bytes out of such a message; nothing if it is another one or has a layout.
[[nodiscard]] std::optional<std::span<const std::byte>> bytes_of_uint8_multi_array(
    std::span<const std::byte> message);

}  // namespace iog::tools::ros
