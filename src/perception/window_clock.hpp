// The clock of the window, which never runs backwards. After the first pose, the window's clock
// follows the clock of the poses. While the clock of the poses is unknown, restarts or jumps, the
// window's clock follows the target's clock. A timestamp in a message can therefore neither advance
// the window's clock far into the future nor stop it.
#pragma once

#include <cstdint>
#include <optional>

namespace iog::perception {

// Returns the end of a frame on the clock of the poses, in us. The result is the end of the frame's
// last slice, clamped to the range from kLostUs before the newest pose to kLateUs after
// `source_now_us`. A scanner's clock that runs fast or slow therefore cannot shift the window's
// time beyond this range. If none of the frame's packets has a timestamp, the result is the time of
// the newest pose. The window's time therefore stops while no sender transmits. `source_now_us` is
// the current time on the clock of the poses (pose::Source::source_time()).
[[nodiscard]] std::uint64_t end_of_frame(std::optional<std::uint64_t> slices_end_us,
                                         std::uint64_t source_now_us, std::uint64_t newest_pose_us);

class WindowClock {
 public:
  // Call start() before the first frame. `now_us` is always a time on the target's clock.
  void start(std::uint64_t now_us) { moved_us_ = now_us; }

  // Ends a frame. `time_us` is the frame's end on the clock of the poses, if it is known. `is_anew`
  // is true if the poses do not continue those of the previous frame (pose::History::epoch()).
  void end_frame(std::optional<std::uint64_t> time_us, bool is_anew, std::uint64_t now_us);

  // Returns the timestamp of the last completed frame.
  [[nodiscard]] std::uint64_t stamp_us() const { return stamp_us_; }

 private:
  std::uint64_t stamp_us_ = 0;
  std::uint64_t moved_us_ = 0;   // time of the last advance, on the target's clock
  std::uint64_t offset_us_ = 0;  // to the clock of the poses, modulo 2^64
  bool has_time_ = false;        // the clock of the poses was known at least once
  bool had_time_ = false;        // it was known in the previous frame
};

}  // namespace iog::perception
