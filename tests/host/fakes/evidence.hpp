// Scan points for tests, and the sensors that saw them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "fakes/random.hpp"
#include "lidar/scan_point.hpp"

namespace iog::tests {

struct Evidence {
  std::size_t sensor = 0;
  lidar::ScanPoint point;
};

// Of three LUX.
inline std::vector<Evidence> random_frame(Random& random, int points) {
  std::vector<Evidence> frame;
  for (int i = 0; i < points; ++i) {
    Evidence evidence;
    evidence.sensor = static_cast<std::size_t>(random.between(0, 2));
    // Close together, so that carving, marks and saturation meet in the same cells.
    const int azimuth = random.between(-300, 300);
    evidence.point = {
        .range_mm =
            static_cast<std::uint32_t>(random.one_in(30) ? 0 : random.between(20, 5200) * 10),
        .azimuth_ticks = static_cast<std::uint16_t>(azimuth < 0 ? azimuth + 11520 : azimuth),
        .layer = static_cast<std::uint8_t>(random.between(0, 3)),
        .echo = static_cast<std::uint8_t>(random.one_in(8) ? 1 : 0),
        .is_ground = random.one_in(20)};
    frame.push_back(evidence);
  }
  return frame;
}

}  // namespace iog::tests
