// Detects that the packets of one address to one port are those of several units.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "lidar/scan_point.hpp"

namespace iog::tools {

// The next packet of a unit that turns begins where the one before ends, and the next scan of a LUX
// has the next number. If several units send, many packets continue an earlier packet than the
// last one. A copy of a packet must be left out.
class UnitMix {
 public:
  // Takes the next packet. ticks_per_turn is 0 for a LUX.
  void add(const lidar::PacketInfo& info, std::uint32_t source_ipv4, std::uint32_t ticks_per_turn);

  // Whether a quarter of the packets, or of the scans of a LUX, continue an earlier one.
  [[nodiscard]] bool is_of_several() const;

 private:
  struct Seen {
    std::uint32_t source_ipv4 = 0;
    std::uint32_t ticks_per_turn = 0;
    lidar::PacketInfo info{};
  };

  [[nodiscard]] static bool is_next(const Seen& before, const Seen& packet);

  // The last packet first; those that another one has continued are left out.
  std::array<Seen, 4> seen_{};
  std::uint64_t steps_ = 0;
  std::uint64_t switches_ = 0;  // steps that continue an earlier packet
};

}  // namespace iog::tools
