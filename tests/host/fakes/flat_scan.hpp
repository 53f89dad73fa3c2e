// A 2D scanner of one level layer over 270 degrees, as robots have it, and the datagrams of its
// scans.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <random>
#include <vector>

#include "fakes/points_packet.hpp"
#include "lidar/laser.hpp"
#include "tools/car/scanners.hpp"

namespace iog::tests {

struct FlatScanner {
  static constexpr std::array kLasers{lidar::Laser{}};
  static constexpr description::Description kDescription{
      .name = "robot", .z_min_m = 0.05, .z_max_m = 0.6};

  static description::SensorConfig config(double pitch_deg = 0) {
    description::SensorConfig config = description::scanner_of(lidar::kFormat<lidar::Points>);
    config.name = "flat";
    config.udp_port = 100;
    config.mount = {.z_m = 0.4, .pitch_deg = pitch_deg};
    config.lasers = kLasers;
    config.range_min_mm = 100;
    config.range_max_mm = 20'000;
    config.no_return_clears_mm = 20'000;
    config.scan_width_ticks = 270 * 32;
    config.max_points_per_scan = 2'000;
    return config;
  }
};

class FlatScans {
 public:
  // The datagrams of the next scan, of four beams a degree. Each is so long, mm, but for some noise
  // without which a unit is frozen. Nothing comes back from 0.
  std::vector<std::vector<std::byte>> scan(const std::function<int(int azimuth_deg)>& range_mm) {
    constexpr int kBeams = 72;  // of a datagram
    constexpr int kDatagrams = 270 * 4 / kBeams;
    constexpr int kTurn = 1'152'000;
    constexpr int kApart = kTurn / 360 / 4;
    ++number_;
    std::vector<std::vector<std::byte>> datagrams;
    for (int i = 0; i < kDatagrams; ++i) {
      const int begin = i * kBeams - 135 * 4;
      PointsPacket packet{
          .scan_number = number_,
          .number = i,
          .datagrams = kDatagrams,
          .time_us = number_ * std::uint64_t{100'000},
          .sector_begin = static_cast<std::uint32_t>((begin * kApart + kTurn) % kTurn),
          .sector_width = kBeams * kApart};
      for (int beam = begin; beam < begin + kBeams; ++beam) {
        const int length = range_mm(beam / 4);
        packet.points.push_back({.first = (beam * kApart + kTurn) % kTurn,
                                 .third = length == 0 ? 0 : length + static_cast<int>(noise_() % 8),
                                 .flags = length == 0 ? 0x04 : 0});
      }
      datagrams.push_back(packet.bytes());
    }
    return datagrams;
  }

 private:
  std::uint32_t number_ = 0;
  std::minstd_rand noise_;
};

}  // namespace iog::tests
