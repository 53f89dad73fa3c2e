// The time of the window: it goes on by the clock of the poses, from the first one on, and never
// back. Where that clock is not known, begins anew or leaps, time goes on by the target's clock. So
// no clock of a message takes it far ahead, or keeps it.
#pragma once

#include <cstdint>
#include <optional>

namespace iog::perception {

// When a frame ends by the clock of the poses, us: with its last slice, or with the newest pose
// where none of its packets has a time, so that a pause of all who send is none for the window. A
// scanner whose clock is ahead cannot take the window's time with it, nor one that is behind keep
// it.
// source_now_us: what the clock of the poses shows now (pose::Source::source_time()).
[[nodiscard]] std::uint64_t end_of_frame(std::optional<std::uint64_t> slices_end_us,
                                         std::uint64_t source_now_us, std::uint64_t newest_pose_us);

class WindowClock {
 public:
  // Before the first frame. Times of the target's clock are called now_us.
  void start(std::uint64_t now_us) { moved_us_ = now_us; }

  // A frame has ended. time_us: by the clock of the poses, if it is known. is_anew: the poses do
  // not belong to those of the frame before (pose::History::epoch()).
  void end_frame(std::optional<std::uint64_t> time_us, bool is_anew, std::uint64_t now_us);

  // Of the frame that has ended.
  [[nodiscard]] std::uint64_t stamp_us() const { return stamp_us_; }

 private:
  std::uint64_t stamp_us_ = 0;
  std::uint64_t moved_us_ = 0;   // when it moved last, by the target's clock
  std::uint64_t offset_us_ = 0;  // to the clock of the poses, modulo 2^64
  bool has_time_ = false;        // it has begun with a clock of the poses,
  bool had_time_ = false;        // which was known in the frame before
};

}  // namespace iog::perception
