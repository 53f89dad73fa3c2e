// Whether the loop keeps up with what comes.
//
// A target that is too slow for its sensors never finds the receive ring empty. What waits there
// grows old, and in the end the controller drops frames unread. So what waits is left, and
// counted, as soon as the loop has been busy for as long as the ring holds: the frames that go out
// are of what is fused, and no older.
#pragma once

#include <cstdint>

namespace iog::app {

class Backlog {
 public:
  // The receive ring holds 100 ms of the densest traffic that it is made for. This is less, and two
  // frames of four LUX, so that one late frame leaves nothing.
  static constexpr std::uint64_t kLongestUs = 80'000;
  // A frame that was over before the loop woke is not closed before what has come meanwhile is
  // taken, for so long: most of it may have come while the machine stood still.
  static constexpr std::uint64_t kGraceUs = 40'000;

  // A pass of the loop begins. What came while the loop slept, or was not run, has not waited for
  // it.
  void begin_pass(std::uint64_t now_us) {
    has_slept_ = !is_busy_;
    if (has_slept_) {
      begin(now_us);
    }
    pass_us_ = now_us;
  }

  // The ring was found empty.
  void clear() { is_busy_ = false; }
  // What was in it has been left.
  void begin(std::uint64_t now_us) {
    is_busy_ = true;
    since_us_ = now_us;
  }

  [[nodiscard]] bool is_too_long(std::uint64_t now_us) const {
    return is_busy_ && now_us - since_us_ >= kLongestUs;
  }

  // Whether fusing has to wait for the end of a frame with packets, whose time is over at
  // deadline_us.
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
