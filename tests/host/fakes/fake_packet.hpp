// A packet of chosen points, as FrameFusion asks of a decoder.
#pragma once

#include <algorithm>
#include <vector>

#include "lidar/sampling.hpp"
#include "lidar/scan_point.hpp"

namespace iog::tests {

// Its samples are chosen, too, whatever the sampling.
struct FakePacket {
  std::vector<lidar::ScanPoint> points;
  std::vector<lidar::ScanPoint> samples;

  template <typename Visit>
  void for_each_point(Visit&& visit) const {
    std::ranges::for_each(points, visit);
  }
  template <typename Visit>
  void for_each_sample(const lidar::Sampling& /*sampling*/, Visit&& visit) const {
    std::ranges::for_each(samples, visit);
  }
};

}  // namespace iog::tests
