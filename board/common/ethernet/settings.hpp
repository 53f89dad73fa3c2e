// What an Ethernet controller is set up with.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "board/common/ethernet/clause_22.hpp"

namespace iog::board {

using MacAddress = std::array<std::uint8_t, 6>;

// Of a frame without its FCS.
inline constexpr std::size_t kMinFrameBytes = 14;
inline constexpr std::size_t kMaxFrameBytes = 1514;

// All that must not change while the controller runs, and the filter.
struct PortSettings {
  MacAddress address{};
  std::uint64_t groups = 0;  // bins of the filter's hash table for groups
  Link mode;                 // speed and duplex
  // Where the first descriptors are, as the bus sees them.
  std::uint32_t receive_ring = 0;
  std::uint32_t transmit_ring = 0;
};

}  // namespace iog::board
