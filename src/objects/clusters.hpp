// Groups the unowned hits of a frame into clusters.
//
// A cluster grows from its first hit. A hit joins the cluster if, along each axis, its distance
// from a hit in the cluster is at most the gap. The gap is 0.4 m plus an amount that grows with
// range, because beams diverge. Old hits are ignored. Cells are stored as bits in a plane that
// covers the window. For each cell of a cluster, the plane is searched for set bits within the gap.
// Bits that are found are cleared, so that no cell is found twice.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "objects/frame_hits.hpp"
#include "objects/grouped.hpp"
#include "objects/plane.hpp"
#include "window/area.hpp"

namespace iog::objects {

struct Cluster {
  Bounds bounds{};  // of the centres of its cells
  std::uint32_t hits = 0;
  std::int16_t owner = kNobody;  // the track to which it was assigned
};

// Returns the gap at a given point, in mm.
[[nodiscard]] std::int32_t gap_mm(Point car, Point at);

class Clusters {
 public:
  // Assigns each hit that is not old to a cluster, in the order of the hits. Returns the number of
  // hits that have no cluster because all kMostClusters clusters were in use.
  std::uint32_t find(const window::Area& area, Point car, FrameHits& hits);

  [[nodiscard]] std::span<Cluster> all() { return std::span(clusters_).first(count_); }
  // Returns the indices of the hits of a cluster.
  [[nodiscard]] std::span<const std::uint16_t> hits_of(std::size_t cluster) const {
    return hits_.of(cluster);
  }

 private:
  static constexpr std::size_t kWords = std::size_t{window::kCellsAcross} / 32;

  [[nodiscard]] geometry::Cell in_window(const FrameHit& hit) const {
    return {hit.cell.x - first_.x, hit.cell.y - first_.y};
  }
  void begin(FrameHits& hits);
  void grow(std::size_t seed, FrameHits& hits);
  void take_around(const FrameHit& hit, FrameHits& hits);
  void take_cell(geometry::Cell cell, FrameHits& hits);
  void clear(FrameHits& hits);

  geometry::Cell first_{};  // lowest cell of the window
  Point car_{};
  std::array<std::array<std::uint32_t, kWords>, window::kCellsAcross> plane_{};
  std::array<std::uint16_t, kMostHits>
      queue_{};  // the first hit of each found cell, in the order of discovery
  std::size_t queued_ = 0;
  std::array<Cluster, kMostClusters> clusters_{};
  std::size_t count_ = 0;
  ClusterHits hits_{};
};

}  // namespace iog::objects
