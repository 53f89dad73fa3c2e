// The clock of a capture. It starts at 0 with the first packet and never runs backwards. A pause
// lasts at most a second, so that a strange capture makes neither millions of empty frames nor a
// replay of days.
#pragma once

#include <algorithm>
#include <cstdint>

namespace iog::tools {

class CaptureClock {
 public:
  static constexpr std::uint64_t kLongestPauseUs = 1'000'000;

  // Moves on to a packet with this time stamp. Returns its time in microseconds since the start.
  std::uint64_t move_to(std::uint64_t capture_us) {
    if (has_started_ && capture_us > last_capture_us_) {
      now_us_ += std::min(capture_us - last_capture_us_, kLongestPauseUs);
    }
    last_capture_us_ = has_started_ ? std::max(last_capture_us_, capture_us) : capture_us;
    has_started_ = true;
    return now_us_;
  }

 private:
  bool has_started_ = false;
  std::uint64_t last_capture_us_ = 0;
  std::uint64_t now_us_ = 0;
};

}  // namespace iog::tools
