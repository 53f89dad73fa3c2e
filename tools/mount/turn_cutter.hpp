// Where one turn of a lidar ends and the next begins, by the packets alone.
#pragma once

#include <cstdint>

#include "lidar/scan_point.hpp"

namespace iog::tools {

class TurnCutter {
 public:
  explicit TurnCutter(std::int32_t ticks_per_turn)
      : turn_(static_cast<std::uint32_t>(ticks_per_turn)) {}

  // The next packet. True: a turn was whole before it, and it is of another one.
  [[nodiscard]] bool ends_before(const lidar::PacketInfo& info);

  // Of the turn that has begun, with packets that were lost between others.
  [[nodiscard]] bool is_nearly_whole() const { return gained_ > turn_ / 4 * 3; }

 private:
  std::uint32_t turn_;
  std::uint32_t at_ = 0;
  std::uint32_t gained_ = 0;
  bool has_begun_ = false;
};

}  // namespace iog::tools
