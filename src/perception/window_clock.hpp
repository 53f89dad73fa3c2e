// The time of the window, which never runs back. It follows the clock of the poses from the first
// pose on. While that clock is unknown, restarts or leaps, time follows the target's clock. So no
// clock in a message can move time far ahead, or stop it.
#pragma once

#include <cstdint>
#include <optional>

namespace iog::perception {

// End of a frame by the clock of the poses, us: the end of its last slice, or the newest pose if
// none of its packets has a time. So the window's time stands still while all senders pause. A
// scanner's clock that is ahead or behind can neither advance the window's time nor hold it back.
// source_now_us: the present time of the poses' clock (pose::Source::source_time()).
[[nodiscard]] std::uint64_t end_of_frame(std::optional<std::uint64_t> slices_end_us,
                                         std::uint64_t source_now_us, std::uint64_t newest_pose_us);

class WindowClock {
 public:
  // Call before the first frame. now_us is always a time of the target's clock.
  void start(std::uint64_t now_us) { moved_us_ = now_us; }

  // Ends a frame. time_us: its end by the clock of the poses, if known. is_anew: the poses do not
  // continue those of the previous frame (pose::History::epoch()).
  void end_frame(std::optional<std::uint64_t> time_us, bool is_anew, std::uint64_t now_us);

  // Stamp of the frame that has ended.
  [[nodiscard]] std::uint64_t stamp_us() const { return stamp_us_; }

 private:
  std::uint64_t stamp_us_ = 0;
  std::uint64_t moved_us_ = 0;   // time of its last advance, by the target's clock
  std::uint64_t offset_us_ = 0;  // to the clock of the poses, modulo 2^64
  bool has_time_ = false;        // a clock of the poses was known at least once
  bool had_time_ = false;        // it was known in the previous frame
};

}  // namespace iog::perception
