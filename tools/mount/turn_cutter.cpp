#include "tools/mount/turn_cutter.hpp"

namespace iog::tools {

bool TurnCutter::ends_before_scan(const lidar::PacketInfo& info) {
  const auto ahead = static_cast<std::int16_t>(info.scan_number - at_);
  if (has_begun_ && ahead < 0) {
    return false;  // it was overtaken
  }
  const bool ends = has_begun_ && ahead > 0;
  has_begun_ = true;
  at_ = info.scan_number;
  gained_ = (ends ? 0 : gained_) + info.sector.width_ticks;
  return ends;
}

// All units turn clockwise, and azimuths count the other way: a packet is as far as its sector
// begins.
bool TurnCutter::ends_before(const lidar::PacketInfo& info) {
  if (is_by_scan_) {
    return ends_before_scan(info);
  }
  const std::uint32_t first = info.sector.first_ticks;
  const std::uint32_t gained = has_begun_ ? (at_ + turn_ - first) % turn_ : 0;
  if (gained > turn_ / 8 * 7) {
    return false;  // it was overtaken
  }
  has_begun_ = true;
  at_ = first;
  gained_ += gained;
  const bool ends = gained_ >= turn_;
  gained_ -= ends ? turn_ : 0;
  return ends;
}

}  // namespace iog::tools
