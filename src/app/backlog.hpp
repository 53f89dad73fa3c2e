// Tells whether the loop keeps up with incoming datagrams.
//
// A target that is too slow for its sensors never empties the receive ring. The waiting frames grow
// old, and in the end the controller drops new ones unread. So once the loop has been busy for as
// long as the ring can hold traffic, the waiting datagrams are shed and counted. The grids sent are
// then never older than that.
#pragma once

#include <cstdint>

namespace iog::app {

class Backlog {
 public:
  // Longest time without an empty ring. The receive ring holds 100 ms of the densest traffic that
  // it is made for. This limit is shorter, and as long as two frames of four LUX, so that one late
  // frame sheds nothing.
  static constexpr std::uint64_t kLongestUs = 80'000;
  // Grace period for a frame whose deadline passed before the loop woke. Most of its datagrams may
  // have arrived while the machine was not running, so they are taken before the frame is closed.
  static constexpr std::uint64_t kGraceUs = 40'000;

  // Begins a pass of the loop. Datagrams that arrived while the loop slept, or was not run, have
  // not waited for it.
  void begin_pass(std::uint64_t now_us) {
    has_slept_ = !is_busy_;
    if (has_slept_) {
      begin(now_us);
    }
    pass_us_ = now_us;
  }

  // The ring was found empty.
  void clear() { is_busy_ = false; }
  // The ring's content was shed.
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
