// Checks whether the loop keeps up with incoming datagrams.
//
// If a target is too slow for its sensors, the loop never empties the receive ring. The waiting
// Ethernet frames become stale, and eventually the controller drops new frames unread. If the ring
// has been continuously non-empty for kLongestUs, the loop sheds and counts the waiting datagrams.
// As a result, the delay of the target's grids never exceeds kLongestUs.
#pragma once

#include <cstdint>

namespace iog::app {

class Backlog {
 public:
  // The maximum time for which the ring may stay non-empty. The receive ring is designed to buffer
  // 100 ms of the densest traffic, so the maximum must be less than 100 ms. The maximum equals two
  // frame periods of a car with four LUX units, so a single late frame does not cause shedding.
  static constexpr std::uint64_t kLongestUs = 80'000;
  // The grace period for a frame whose deadline passed before the loop woke up. Most datagrams of
  // such a frame may have arrived while the machine was not running. The loop processes these
  // datagrams before it closes the frame.
  static constexpr std::uint64_t kGraceUs = 40'000;

  // Begins a pass of the loop. Datagrams that arrived while the loop was asleep or not running are
  // not counted as waiting.
  void begin_pass(std::uint64_t now_us) {
    has_slept_ = !is_busy_;
    if (has_slept_) {
      begin(now_us);
    }
    pass_us_ = now_us;
  }

  // Call this function when the ring is empty.
  void clear() { is_busy_ = false; }
  // Call this function after shedding the datagrams in the ring.
  void begin(std::uint64_t now_us) {
    is_busy_ = true;
    since_us_ = now_us;
  }

  [[nodiscard]] bool is_too_long(std::uint64_t now_us) const {
    return is_busy_ && now_us - since_us_ >= kLongestUs;
  }

  // Returns true if fusing must stop because a frame with packets is due to close. `deadline_us` is
  // the frame's deadline.
  [[nodiscard]] bool must_yield(std::uint64_t deadline_us, std::uint64_t now_us) const {
    const bool was_over = has_slept_ && deadline_us <= pass_us_;
    return now_us >= deadline_us && !(was_over && now_us - pass_us_ < kGraceUs);
  }

 private:
  bool is_busy_ = false;
  bool has_slept_ = false;  // before this pass
  std::uint64_t since_us_ = 0;
  std::uint64_t pass_us_ = 0;
};

}  // namespace iog::app
