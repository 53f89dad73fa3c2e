// Names of scanners, for people.
#pragma once

#include <string>

#include "lidar/velodyne_identity.hpp"

namespace iog::tools {

// "Velodyne HDL-32E or Velodyne VLP-16"; empty for none.
[[nodiscard]] std::string names_of(const lidar::FormatSet& formats);

}  // namespace iog::tools
