// The part of a vehicle's description that defines the pose source.
#pragma once

#include <cstdint>

#include "pose/message.hpp"

namespace iog::pose {

struct SourceDescription {
  std::uint32_t source_ipv4 = 0;       // address of the sender, or 0 if any sender is accepted
  std::uint16_t udp_port = kPosePort;  // port that receives its messages
  std::uint8_t log2_slice_ms = 3;      // a slice is 2^this milliseconds long, 0 ... 6

  [[nodiscard]] constexpr bool is_valid() const { return udp_port != 0 && log2_slice_ms <= 6; }
};

}  // namespace iog::pose
