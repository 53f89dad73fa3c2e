// What a single data packet reveals about a unit: the bytes that identify the unit, and the
// rotation of the head during the packet.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "lidar/velodyne_bytes.hpp"

namespace iog::lidar {

struct VelodyneLook {
  std::uint8_t banks = 1;     // number of blocks that share one azimuth in single return mode
  std::uint8_t mode = 0;      // with two banks, this byte and the next byte mean something else
  std::uint8_t product = 0;   // identifies the unit
  bool is_dual = false;       // each beam has two returns
  std::uint32_t time_us = 0;  // time since the full hour
  std::uint32_t azimuth = 0;  // azimuth of the first block, in units of 0.01 degrees
  std::uint32_t gain = 0;     // azimuth increment from the first to the last azimuth
  std::uint32_t steps = 0;    // number of azimuth steps in gain
};

// Accepts any bytes of this length.
[[nodiscard]] VelodyneLook look_at(std::span<const std::byte, velodyne::kPacketBytes> packet);

}  // namespace iog::lidar
