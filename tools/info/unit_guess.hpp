// Which Ouster or Hesai a packet is of, without a description: every unit that would believe it is
// tried.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "lidar/scan_point.hpp"

namespace iog::tools {

struct GuessedPacket {
  std::string name;  // and rows: "Ouster OS, legacy 64"
  std::uint32_t ticks_per_turn = 0;
  bool is_numbered = false;  // whether its packets say in which scan they are
  lidar::PacketInfo info;
};

// Nothing if none of them sends such bytes. A packet of an Ouster may fit several modes, and is
// taken for one of the fewest columns; see lidar/ouster.hpp for what it cannot say.
[[nodiscard]] std::optional<GuessedPacket> guess_unit(std::span<const std::byte> payload);

}  // namespace iog::tools
