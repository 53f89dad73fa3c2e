// Objects as a scene of Foxglove and as markers of ROS 2, serialised.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "stream/objects.hpp"

namespace iog::tools::ros {

// The objects of a frame, and what a reader needs to draw them.
struct ObjectScene {
  std::uint64_t stamp_us = 0;     // what timestamp is to be
  std::uint64_t lifetime_us = 0;  // after which an object that is not named again is gone
  std::span<const stream::ObjectRecord> objects;
  std::span<const std::uint32_t> gone;  // ids that were named before and are not any more
};

// foxglove_msgs/msg/SceneUpdate in the local frame. An entity for each object has its id, a cube
// from the ground to 1.5 m, at least a cell wide, an arrow of one second's way if it moves, and
// words. The colour is that of the class; what was not hit in this frame is fainter.
[[nodiscard]] std::vector<std::byte> scene_update(const ObjectScene& scene);

// visualization_msgs/msg/MarkerArray of the same: namespaces `box`, `way` and `words`, the id that
// of the object as a signed number, behind a marker that takes all earlier ones away. `gone` is of
// no use.
[[nodiscard]] std::vector<std::byte> marker_array(const ObjectScene& scene);

// Such as "7: 43 ± 4 km/h": speed and two standard deviations of it along the heading, rounded up;
// within these of 0 no speed.
[[nodiscard]] std::string words_of(const stream::ObjectRecord& object);

}  // namespace iog::tools::ros
