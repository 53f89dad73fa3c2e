// Whose packets these are: the one place that names a unit from its packets, whether iogrid takes
// its points or not, and without a description of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "lidar/scan_point.hpp"
#include "lidar/velodyne_identity.hpp"

namespace iog::tools {

struct SeenUnit {
  // "Ouster OS, legacy 64"; in doubt all that it may be of; empty: of no lidar that is known.
  std::string name;
  // Those of ours that may have sent it; none: iogrid takes no packet of such a unit.
  lidar::FormatSet formats;
  // Of two units of Velodyne's it may be either's.
  bool is_in_doubt = false;
  // Whether a decoder believes it; what follows is of such a packet alone. A packet of one of our
  // formats that its decoder does not believe has the decoder's reason.
  bool is_sound = false;
  lidar::DecodeStatus status = lidar::DecodeStatus::kOk;
  lidar::PacketInfo info{};
  std::uint32_t ticks_per_turn = 0;
  bool is_numbered = false;  // whether its packets say in which scan they are
  bool turns = false;
};

class UnitWatch {
 public:
  // The next packet of one sender to one port. An Ouster's may fit several modes, and is taken for
  // one of the fewest columns; see lidar/ouster.hpp for what it cannot say.
  [[nodiscard]] SeenUnit take(std::span<const std::byte> payload);

 private:
  lidar::VelodyneIdentity velodyne_;
};

}  // namespace iog::tools
