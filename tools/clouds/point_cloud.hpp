// A point cloud as KITTI keeps it: float32 x, y, z and reflectance of each point, little endian, in
// metres in the frame of the unit, back to back.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace iog::tools {

struct CloudPoint {
  double x = 0;
  double y = 0;
  double z = 0;
};

struct PointCloud {
  std::vector<CloudPoint> points;
  std::size_t not_finite = 0;  // left out: a coordinate is no number
};

// More than any unit sees in a turn.
inline constexpr std::size_t kMostCloudPoints = 1'000'000;

// A file with one cloud. UsageError if it cannot be read, or is larger than so many points are with
// 128 bytes each.
[[nodiscard]] std::vector<std::byte> read_cloud_file(const std::string& path);

// Of four numbers a point or, as nuScenes keeps clouds, of five. UsageError if the file cannot be
// read, has no whole number of points, or more points than that.
[[nodiscard]] PointCloud read_cloud(const std::string& path, std::size_t numbers = 4);

}  // namespace iog::tools
