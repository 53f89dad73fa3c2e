// What a Velodyne data packet reveals about the unit that sent it: the bytes that name the unit,
// and how far the head turned during the packet. lidar/velodyne.hpp decodes its points.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lidar/velodyne_bytes.hpp"

namespace iog::lidar {

struct VelodyneLook {
  std::uint8_t banks = 1;     // blocks that share an azimuth when each beam has one return
  std::uint8_t mode = 0;      // with two banks, this byte and the next have other meanings
  std::uint8_t product = 0;   // names the unit
  bool is_dual = false;       // each beam has two returns
  std::uint32_t time_us = 0;  // since the hour
  std::uint32_t azimuth = 0;  // of the first block, 0.01 degrees
  std::uint32_t gain = 0;     // from the first to the last azimuth
  std::uint32_t steps = 0;    // number of azimuth steps in gain
};

// Accepts any bytes of this length.
[[nodiscard]] VelodyneLook look_at(std::span<const std::byte, velodyne::kPacketBytes> packet);

}  // namespace iog::lidar
