// A Velodyne data packet as its unit sends it; lidar/velodyne.hpp reads it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "lidar/velodyne.hpp"

namespace iog::tools {

struct VelodyneBlock {
  std::uint16_t azimuth_ticks = 0;  // clockwise, 0.01 degrees
  // By channel, in units of the wire; 0: nothing came back.
  std::array<std::uint16_t, lidar::VelodynePacket::kPointsPerBlock> ranges{};
};

using VelodyneBlocks = std::array<VelodyneBlock, lidar::VelodynePacket::kBlocks>;

// One return for each beam. begin_us: when its first block fires, since any full hour; number: how
// many packets the unit has sent before.
[[nodiscard]] std::vector<std::byte> data_packet(const lidar::VelodyneUnit& unit,
                                                 const VelodyneBlocks& blocks,
                                                 std::uint64_t begin_us, std::uint64_t number);

}  // namespace iog::tools
