// The settings of an Ethernet controller.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "board/common/ethernet/clause_22.hpp"

namespace iog::board {

using MacAddress = std::array<std::uint8_t, 6>;

// The limits of a frame's length, without the FCS.
inline constexpr std::size_t kMinFrameBytes = 14;
inline constexpr std::size_t kMaxFrameBytes = 1514;

// The settings of the controller. Except for the filter, the settings must not change while the
// controller runs.
struct PortSettings {
  MacAddress address{};
  std::uint64_t groups = 0;  // bins of the filter's hash table for groups
  Link mode;                 // speed and duplex
  // The bus addresses of the first descriptors.
  std::uint32_t receive_ring = 0;
  std::uint32_t transmit_ring = 0;
};

}  // namespace iog::board
