// A folder of point clouds and poses, as the KITTI data sets keep them.
//
// Raw data (Geiger and others, 2013): velodyne_points/timestamps.txt, when the unit looked forward,
// a line a turn; velodyne_points/data/0000000000.bin and so on; oxts as iog pose reads it. Clouds
// are as measured, each point in the unit's frame at its own time. Odometry and SemanticKITTI:
// times.txt, seconds a line; velodyne/000000.bin and so on; poses.txt, of camera 0, and calib.txt,
// whose Tr brings the unit's frame into the camera's. Clouds are corrected for the car's motion:
// all points are in the unit's frame when it looked forward.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/clouds/head.hpp"
#include "tools/poses/pose_log.hpp"

namespace iog::tools {

struct CloudSet {
  std::string times{};  // the file that has them
  std::vector<ForwardTime> forward{};
  std::vector<std::string> clouds{};  // for each time a file; empty: there is none
  bool is_corrected = false;          // for the car's motion
  // Where the receiver of the poses was, or the unit itself if they are of it. May be empty.
  PoseLog poses{};
  std::vector<std::string> remarks{};  // what is not there
};

// UsageError if the folder has neither form, a file of it cannot be read or is not what it has to
// be, or there is no cloud.
[[nodiscard]] CloudSet read_cloud_set(const std::string& folder);

}  // namespace iog::tools
