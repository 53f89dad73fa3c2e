// The surroundings of the car as a sparse set of points in voxels, with planes through them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <unordered_map>
#include <vector>

namespace iog::tools {

inline constexpr double kVoxelM = 1;

// At most one point per cube of this edge length, the first one, in the given order.
[[nodiscard]] std::vector<std::size_t> thinned(std::span<const Eigen::Vector3d> points,
                                               double edge_m);

struct SurfacePlane {
  Eigen::Vector3d normal;
  double offset_m;  // normal * x = offset
  double flatness;  // 0: the points are as thick as wide; 1: they lie in the plane and fill it
};

class LocalMap {
 public:
  // Points closer to another than about 0.2 m are left out, so the size is bounded by the volume.
  void add(std::span<const Eigen::Vector3d> points);
  void forget_beyond(const Eigen::Vector3d& middle, double distance_m);

  // The plane through the nearest points, if the nearest of these is closer than most_m, which is
  // at most kVoxelM.
  [[nodiscard]] std::optional<SurfacePlane> plane_at(const Eigen::Vector3d& place,
                                                     double most_m) const;

  [[nodiscard]] bool is_empty() const { return voxels_.empty(); }

 private:
  using Voxel = std::vector<Eigen::Vector3d>;
  std::unordered_map<std::uint64_t, Voxel> voxels_;
};

}  // namespace iog::tools
