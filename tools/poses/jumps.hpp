// How much time of a pose log a target loses by jumps.
#pragma once

#include <cstdint>
#include <vector>

#include "tools/formats/capture/datagram.hpp"

namespace iog::tools {

struct JumpTime {
  std::uint64_t lost_us = 0;
  std::uint64_t all_us = 0;
};

// A step between two messages is lost if a target finds a jump at its middle. At most kLateUs of a
// step counts as lost.
[[nodiscard]] JumpTime time_lost_by_jumps(const std::vector<CapturedDatagram>& poses);

}  // namespace iog::tools
