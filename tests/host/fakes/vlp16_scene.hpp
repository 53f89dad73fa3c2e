// Packets of a VLP-16 that looks at made-up scenes.
#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <random>
#include <vector>

#include "fakes/velodyne_packet.hpp"

namespace iog::tests {

// How far a beam goes, m; 0: it does not come back. Degrees clockwise from the unit's front, and up
// from its own level.
using Scene = std::function<double(double azimuth_deg, int elevation_deg)>;

// A flat field under an open sky, 1.5 m below. What is beyond 60 m does not come back.
inline double field(double /*azimuth_deg*/, int elevation_deg) {
  const double range_m = 1.5 / std::sin(-elevation_deg * std::numbers::pi / 180);
  return elevation_deg < 0 && range_m < 60 ? range_m : 0;
}
inline double covered(double /*azimuth_deg*/, int /*elevation_deg*/) { return 0; }

// A turn at 10 Hz, 4.8 degrees a packet, from 0 degrees on.
class SceneTurns {
 public:
  [[nodiscard]] std::vector<std::vector<std::byte>> turn(const Scene& scene) {
    std::vector<std::vector<std::byte>> packets;
    for (int first = 0; first < 36'000; first += 480) {
      packets.push_back(packet(scene, first));
    }
    return packets;
  }

 private:
  [[nodiscard]] std::vector<std::byte> packet(const Scene& scene, int first) {
    VelodynePacket sent{.first_azimuth = first, .step = 40, .time_us = ++packets_ * 1'333};
    for (std::size_t block = 0; block < 12; ++block) {
      for (std::size_t channel = 0; channel < 32; ++channel) {
        // VLP-16 User Manual 63-9243, table 9-1: -15, 1, -13, 3, ... 15 degrees.
        const int place = static_cast<int>(channel % 16);
        const int elevation = place % 2 == 0 ? place - 15 : place;
        const double azimuth = (first + 40.0 * static_cast<double>(block)) / 100;
        const double range_m = scene(azimuth, elevation);
        const int noise = static_cast<int>(random_() % 8);
        sent.ranges.at(block).at(channel) =
            range_m > 0 ? static_cast<int>(range_m * 500) + noise : 0;
      }
    }
    return sent.bytes();
  }

  std::minstd_rand random_;
  std::uint32_t packets_ = 0;
};

}  // namespace iog::tests
