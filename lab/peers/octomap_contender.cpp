// OctoMap in both of its ways: a cloud of points at a time, which updates a cell once for each
// cloud, and a ray at a time. Beams lie in one plane, and inner nodes are left for later (lazy), as
// no coarser cell is asked for.
#include <octomap/octomap.h>
#include <vector>

#include "lab/peers/contender.hpp"

namespace iog::lab {
namespace {

// The middle of a layer of cells.
constexpr float kPlaneM = 0.05F;

octomap::point3d in_space(const PointMetres& point) {
  return {static_cast<float>(point.x), static_cast<float>(point.y), kPlaneM};
}

class Tree : public Contender {
 public:
  void clear() override { tree_.clear(); }

  [[nodiscard]] CellCounts count() const override {
    CellCounts counts{.stored = tree_.size()};
    for (auto leaf = tree_.begin_leafs(); leaf != tree_.end_leafs(); ++leaf) {
      ++(tree_.isNodeOccupied(*leaf) ? counts.occupied : counts.free);
    }
    return counts;
  }

 protected:
  [[nodiscard]] octomap::OcTree& tree() { return tree_; }

 private:
  octomap::OcTree tree_{kCellM};
};

double range_m(const PeerFrames& frames) { return frames.vehicle->sensors[0].range.mm() / 1000.0; }

class Clouds final : public Tree {
 public:
  explicit Clouds(const PeerFrames& frames) : range_m_(range_m(frames)) {
    for (const PeerFrame& frame : frames.frames) {
      auto& clouds = frames_.emplace_back(frames.vehicle->sensors.size());
      for (const PeerBeam& beam : frame) {
        clouds[beam.sensor].origin = in_space(beam.origin);
        clouds[beam.sensor].points.push_back(in_space(beam.end));
      }
    }
  }

  void fuse(std::size_t frame) override {
    for (const Cloud& cloud : frames_[frame]) {
      tree().insertPointCloud(cloud.points, cloud.origin, range_m_, true);
    }
  }

 private:
  struct Cloud {
    octomap::point3d origin;
    octomap::Pointcloud points;
  };

  double range_m_;
  std::vector<std::vector<Cloud>> frames_;
};

class Rays final : public Tree {
 public:
  explicit Rays(const PeerFrames& frames) : range_m_(range_m(frames)) {
    for (const PeerFrame& frame : frames.frames) {
      std::vector<Ray>& rays = frames_.emplace_back();
      for (const PeerBeam& beam : frame) {
        rays.push_back({in_space(beam.origin), in_space(beam.end)});
      }
    }
  }

  void fuse(std::size_t frame) override {
    for (const Ray& ray : frames_[frame]) {
      tree().insertRay(ray.origin, ray.end, range_m_, true);
    }
  }

 private:
  struct Ray {
    octomap::point3d origin;
    octomap::point3d end;
  };

  double range_m_;
  std::vector<std::vector<Ray>> frames_;
};

}  // namespace

std::unique_ptr<Contender> make_octomap_clouds(const PeerFrames& frames) {
  return std::make_unique<Clouds>(frames);
}

std::unique_ptr<Contender> make_octomap_rays(const PeerFrames& frames) {
  return std::make_unique<Rays>(frames);
}

}  // namespace iog::lab
