// Describes the sender of maps, as part of a vehicle's description.
#pragma once

#include <cstdint>

#include "map/chunk.hpp"

namespace iog::map {

struct SourceDescription {
  std::uint32_t source_ipv4 = 0;      // address of the sender, or 0 if any sender is accepted
  std::uint16_t udp_port = kMapPort;  // port that receives its messages

  [[nodiscard]] constexpr bool is_valid() const { return udp_port != 0; }
};

}  // namespace iog::map
