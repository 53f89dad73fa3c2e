// What a car file needs to know of the clouds and scans in a recording of ROS 2.
#pragma once

#include <string>

namespace iog::tools {

// Frame, points, elevations and field of view of each topic with clouds or scans, and lines of a
// car file for it; why not, if a message cannot be read.
[[nodiscard]] std::string describe_clouds(const std::string& path);

}  // namespace iog::tools
