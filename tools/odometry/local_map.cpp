#include "tools/odometry/local_map.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <unordered_set>
#include <utility>

namespace iog::tools {
namespace {

constexpr std::size_t kMostInVoxel = 20;
constexpr double kSpacingM = 0.2;
// Enough that a plane has a normal in noise, few enough that a corner does not become a plane.
constexpr double kAroundM = kVoxelM / 2;  // the eight voxels that contain all points as close
constexpr std::size_t kNeighbours = 8;
constexpr std::size_t kFewestNeighbours = 5;

// 21 bits an axis: 1,000 km of a metre each.
std::uint64_t key_of(std::int64_t x, std::int64_t y, std::int64_t z) {
  constexpr std::uint64_t kMask = (std::uint64_t{1} << 21) - 1;
  return (static_cast<std::uint64_t>(x) & kMask) << 42 |
         (static_cast<std::uint64_t>(y) & kMask) << 21 | (static_cast<std::uint64_t>(z) & kMask);
}

using Cell = std::array<std::int64_t, 3>;
Cell cell_of(const Eigen::Vector3d& point, double edge_m) {
  return {std::llround(std::floor(point.x() / edge_m)),
          std::llround(std::floor(point.y() / edge_m)),
          std::llround(std::floor(point.z() / edge_m))};
}

std::uint64_t key_of(const Eigen::Vector3d& point, double edge_m) {
  const auto [x, y, z] = cell_of(point, edge_m);
  return key_of(x, y, z);
}

// The nearest points to a place, by rising distance.
class Nearest {
 public:
  explicit Nearest(const Eigen::Vector3d& place) : place_(place) {}

  void offer(const Eigen::Vector3d& point) {
    const double squared = (point - place_).squaredNorm();
    if (count_ == kNeighbours && squared >= found_.back().first) {
      return;
    }
    std::size_t at = count_ < kNeighbours ? count_++ : kNeighbours - 1;
    for (; at > 0 && found_[at - 1].first > squared; --at) {
      found_[at] = found_[at - 1];
    }
    found_[at] = {squared, &point};
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] double squared(std::size_t i) const { return found_[i].first; }
  [[nodiscard]] const Eigen::Vector3d& point(std::size_t i) const { return *found_[i].second; }

 private:
  Eigen::Vector3d place_;
  std::size_t count_ = 0;
  std::array<std::pair<double, const Eigen::Vector3d*>, kNeighbours> found_{};
};

SurfacePlane plane_through(const Nearest& nearest) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < nearest.count(); ++i) {
    mean += nearest.point(i);
  }
  mean /= static_cast<double>(nearest.count());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < nearest.count(); ++i) {
    const Eigen::Vector3d off = nearest.point(i) - mean;
    spread += off * off.transpose();
  }
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(spread);
  const Eigen::Vector3d sides = solver.eigenvalues().cwiseMax(0).cwiseSqrt();
  const Eigen::Vector3d normal = solver.eigenvectors().col(0);
  return {.normal = normal,
          .offset_m = normal.dot(mean),
          .flatness = sides[2] > 0 ? (sides[1] - sides[0]) / sides[2] : 0};
}

}  // namespace

std::vector<std::size_t> thinned(std::span<const Eigen::Vector3d> points, double edge_m) {
  std::unordered_set<std::uint64_t> taken;
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (taken.insert(key_of(points[i], edge_m)).second) {
      kept.push_back(i);
    }
  }
  return kept;
}

void LocalMap::add(std::span<const Eigen::Vector3d> points) {
  for (const Eigen::Vector3d& point : points) {
    Voxel& voxel = voxels_[key_of(point, kVoxelM)];
    const bool is_new = std::ranges::none_of(voxel, [&](const Eigen::Vector3d& other) {
      return (other - point).squaredNorm() < kSpacingM * kSpacingM;
    });
    if (is_new && voxel.size() < kMostInVoxel) {
      voxel.push_back(point);
    }
  }
}

void LocalMap::forget_beyond(const Eigen::Vector3d& middle, double distance_m) {
  std::erase_if(voxels_, [&](const auto& its) {
    return (its.second.front() - middle).squaredNorm() > distance_m * distance_m;
  });
}

std::optional<SurfacePlane> LocalMap::plane_at(const Eigen::Vector3d& place, double most_m) const {
  Nearest nearest(place);
  for (const double x_m : {-kAroundM, kAroundM}) {
    for (const double y_m : {-kAroundM, kAroundM}) {
      for (const double z_m : {-kAroundM, kAroundM}) {
        const auto found = voxels_.find(key_of(place + Eigen::Vector3d(x_m, y_m, z_m), kVoxelM));
        if (found != voxels_.end()) {
          std::ranges::for_each(found->second, [&](const auto& point) { nearest.offer(point); });
        }
      }
    }
  }
  if (nearest.count() < kFewestNeighbours || nearest.squared(0) > most_m * most_m) {
    return std::nullopt;
  }
  return plane_through(nearest);
}

}  // namespace iog::tools
