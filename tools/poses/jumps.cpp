#include "tools/poses/jumps.hpp"

#include <algorithm>

#include "pose/history.hpp"
#include "pose/limits.hpp"
#include "pose/message.hpp"

namespace iog::tools {

JumpTime time_lost_by_jumps(const std::vector<CapturedDatagram>& poses) {
  JumpTime time;
  pose::History history;
  std::uint64_t before_us = 0;
  for (const CapturedDatagram& datagram : poses) {
    const auto [fate, message] = pose::decode(datagram.payload);
    if (fate != pose::Fate::kUsed || history.add(message, datagram.time_us) != pose::Fate::kUsed) {
      continue;
    }
    const std::uint64_t step_us = before_us > 0 ? message.clock_us - before_us : 0;
    const pose::Cause cause = history.pose_at(message.clock_us - step_us / 2).cause;
    time.all_us += std::min(step_us, pose::kLateUs);
    time.lost_us += cause == pose::Cause::kJump ? std::min(step_us, pose::kLateUs) : 0;
    before_us = message.clock_us;
  }
  return time;
}

}  // namespace iog::tools
