// A grid as a map of ROS map_server (trinary mode): a PGM and the YAML that names it.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/grid.hpp"
#include "index/occupancy_index.hpp"

namespace iog::tools {

// The cells of a grid, row by row from the lowest y.
struct RosMap {
  std::vector<index::OccupancyIndex> cells;
  geometry::Grid grid;
};

// 0 occupied (index above 0), 254 free (below), 205 unknown; x to the right, the row of highest y
// on top. map_server's own thresholds give back the three classes.
[[nodiscard]] std::vector<std::uint8_t> ros_map_pixels(const RosMap& map);

[[nodiscard]] std::string ros_map_yaml(const std::string& image, const RosMap& map);

// Whether iog wrote this .yaml.
[[nodiscard]] bool is_own_ros_map(const std::string& path);

// `base`.pgm and `base`.yaml in the folder. UsageError if they cannot be written.
void write_ros_map(const std::string& folder, const std::string& base, const RosMap& map);

}  // namespace iog::tools
