// Checks whether the loop keeps up with incoming datagrams.
//
// A target that is too slow for its sensors never empties the receive ring. The waiting Ethernet
// frames become outdated, and finally the controller drops new frames unread. Therefore, if the
// loop does not empty the ring for as long as the ring can buffer traffic, the waiting datagrams
// are shed and counted. The grids that the target sends are therefore never delayed by more than
// this time.
#pragma once

#include <cstdint>

namespace iog::app {

class Backlog {
 public:
  // The maximum time without an empty ring. The receive ring can buffer 100 ms of the densest
  // traffic for which it is designed. This limit is shorter. It equals two frames of four LUX, so
  // that a single late frame causes no shedding.
  static constexpr std::uint64_t kLongestUs = 80'000;
  // The grace period for a frame whose deadline passed before the loop woke up. Most of this
  // frame's datagrams may have arrived while the machine was not running. These datagrams are
  // processed before the frame is closed.
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

  // Call it when the ring is empty.
  void clear() { is_busy_ = false; }
  // Call it when the ring's content has been shed.
  void begin(std::uint64_t now_us) {
    is_busy_ = true;
    since_us_ = now_us;
  }

  [[nodiscard]] bool is_too_long(std::uint64_t now_us) const {
    return is_busy_ && now_us - since_us_ >= kLongestUs;
  }

  // Whether fusing must stop so that a frame with packets can be closed at deadline_us.
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
