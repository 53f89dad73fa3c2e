// Where one turn of a lidar ends and the next begins, by the packets alone.
#pragma once

#include <cstdint>

#include "lidar/formats.hpp"
#include "lidar/scan_point.hpp"
#include "lidar/scanner_facts.hpp"

namespace iog::tools {

class TurnCutter {
 public:
  explicit TurnCutter(std::int32_t ticks_per_turn, bool is_by_scan = false)
      : turn_(static_cast<std::uint32_t>(ticks_per_turn)), is_by_scan_(is_by_scan) {}
  // Datagrams of points may turn either way, and each of their scans is a turn.
  explicit TurnCutter(lidar::Format format)
      : TurnCutter(lidar::ticks_per_turn(format), lidar::facts_of(format).is_points) {}

  // The next packet. True: a turn was whole before it, and it is of another one.
  [[nodiscard]] bool ends_before(const lidar::PacketInfo& info);

  // Of the turn that has begun, with packets that were lost between others.
  [[nodiscard]] bool is_nearly_whole() const { return gained_ > turn_ / 4 * 3; }

 private:
  [[nodiscard]] bool ends_before_scan(const lidar::PacketInfo& info);

  std::uint32_t turn_;
  bool is_by_scan_;
  std::uint32_t at_ = 0;  // the newest sector's beginning, or the scan's number
  std::uint32_t gained_ = 0;
  bool has_begun_ = false;
};

}  // namespace iog::tools
