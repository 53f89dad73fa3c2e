// The senders of maps: part of a vehicle's description.
#pragma once

#include <cstdint>

#include "map/chunk.hpp"

namespace iog::map {

struct SourceDescription {
  std::uint32_t source_ipv4 = 0;      // the sender's address, 0: any
  std::uint16_t udp_port = kMapPort;  // where its messages arrive

  [[nodiscard]] constexpr bool is_valid() const { return udp_port != 0; }
};

}  // namespace iog::map
