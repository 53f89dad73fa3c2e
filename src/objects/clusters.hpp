// Clusters: hits of a frame that nobody has taken and that are near to each other, one hit to the
// next.
//
// Two hits are near if they are within the gap of either along both axes: 0.4 m, and more with the
// range, because beams fan out. Old hits are none. Cells are bits of a plane of the window: a
// cluster grows by the bits around each of its cells, and every bit is found once.
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
  std::int16_t owner = kNobody;  // the track of which it becomes a part
};

// The gap of what lies at a point.
[[nodiscard]] std::int32_t gap_mm(Point car, Point at);

class Clusters {
 public:
  // Gives each of those hits its cluster, in the order of hits. Returns how many hits found no room
  // because there are more clusters than kMostClusters.
  std::uint32_t find(const window::Area& area, Point car, FrameHits& hits);

  [[nodiscard]] std::span<Cluster> all() { return std::span(clusters_).first(count_); }
  // The numbers of a cluster's hits.
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

  geometry::Cell first_{};  // the window's lowest cell
  Point car_{};
  std::array<std::array<std::uint32_t, kWords>, window::kCellsAcross> plane_{};
  std::array<std::uint16_t, kMostHits> queue_{};  // the first hits of cells, as they are found
  std::size_t queued_ = 0;
  std::array<Cluster, kMostClusters> clusters_{};
  std::size_t count_ = 0;
  ClusterHits hits_{};
};

}  // namespace iog::objects
