// A folder of point clouds and poses, as the KITTI data sets keep them.
//
// Raw data (Geiger and others, 2013): velodyne_points/timestamps.txt, when the unit looked forward,
// a line a turn; velodyne_points/data/0000000000.bin and so on; oxts as iog pose reads it. Clouds
// are as measured, each point in the unit's frame at its own time. Odometry and SemanticKITTI:
// times.txt, seconds a line; velodyne/000000.bin and so on; poses.txt, of camera 0, and calib.txt,
// whose Tr brings the unit's frame into the camera's. Clouds are corrected for the car's motion:
// all points are in the unit's frame when it looked forward.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "tools/clouds/cloud_fields.hpp"
#include "tools/clouds/head.hpp"
#include "tools/clouds/point_cloud.hpp"
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

// UsageError if the folder has neither form, if a file cannot be read or has the wrong content, if
// there is no cloud, or if the poses are from another time.
[[nodiscard]] CloudSet read_cloud_set(const std::string& folder);

// Where a point of a cloud was in the unit's frame at a time, in microseconds since 1970.
[[nodiscard]] CloudPoint seen_at(const CloudSet& set, std::size_t cloud, const CloudPoint& point,
                                 double time_us);

// One of the clouds, or of nuScenes (.pcd.bin), without times. UsageError as read_cloud().
[[nodiscard]] SeenCloud read_kitti_cloud(const std::string& path, std::uint64_t stamp_us);

// As read_cloud_set(), with the time of each point by its azimuth; calls take(cloud) with each.
// Returns remarks: what is not there. UsageError as read_cloud_set() and Head.
std::vector<std::string> for_each_of_set(const std::string& folder,
                                         const std::function<void(SeenCloud&&)>& take);

}  // namespace iog::tools
