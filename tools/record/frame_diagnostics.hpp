// What a frame says of its target, of its sensors and of the way to here, as ROS 2 has diagnostics.
#pragma once

#include <vector>

#include "tools/formats/ros/diagnostic_messages.hpp"
#include "tools/frames/grid_frame.hpp"

namespace iog::tools {

// Of one frame alone, but for what counts since the target's start; docs/recordings.md has their
// names and when which is no longer OK. What the frame does not say has no diagnostic.
[[nodiscard]] std::vector<ros::Diagnostic> diagnostics_of(const GridFrame& frame);

}  // namespace iog::tools
