// Whether a target calls poses of a log jumps.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/formats/capture/datagram.hpp"

namespace iog::tools {

struct JumpTime {
  std::uint64_t lost_us = 0;
  std::uint64_t all_us = 0;
};

// How much of the time of these messages a target loses by jumps: from message to message, what it
// says of the middle. Behind kLateUs a slice is late anyway.
[[nodiscard]] JumpTime time_lost_by_jumps(const std::vector<CapturedDatagram>& poses);

}  // namespace iog::tools
