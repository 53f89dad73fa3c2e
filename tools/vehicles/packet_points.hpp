// The points of a packet as a list, for whoever can wait for it: Packet::for_each_point() is
// compiled anew for each visitor, once for every format.
#pragma once

#include <algorithm>
#include <vector>

#include "intake/packet.hpp"
#include "lidar/sampling.hpp"
#include "lidar/scan_point.hpp"

namespace iog::tools {

// Of a sound packet, in wire order.
[[nodiscard]] std::vector<lidar::ScanPoint> points_of(const intake::Packet& packet);

// A sound packet for FrameFusion::add_all(), with its points as a list. The packet outlives it.
class ListedPacket {
 public:
  explicit ListedPacket(const intake::Packet& packet)
      : packet_(&packet), points_(tools::points_of(packet)) {}

  [[nodiscard]] const std::vector<lidar::ScanPoint>& points() const { return points_; }

  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    std::ranges::for_each(points_, visit);
  }
  template <typename Visit>
  void for_each_sample(const lidar::Sampling& sampling, Visit&& visit) const {
    std::ranges::for_each(samples(sampling), visit);
  }

 private:
  [[nodiscard]] std::vector<lidar::ScanPoint> samples(const lidar::Sampling& sampling) const;

  const intake::Packet* packet_;
  std::vector<lidar::ScanPoint> points_;
};

}  // namespace iog::tools
