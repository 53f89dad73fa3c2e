#include "perception/window_clock.hpp"

#include <algorithm>

#include "pose/limits.hpp"

namespace iog::perception {

std::uint64_t end_of_frame(std::optional<std::uint64_t> slices_end_us, std::uint64_t source_now_us,
                           std::uint64_t newest_pose_us) {
  const std::uint64_t least_us = newest_pose_us - std::min(newest_pose_us, pose::kLostUs);
  return slices_end_us ? std::max(std::min(*slices_end_us, source_now_us + pose::kLateUs), least_us)
                       : newest_pose_us;
}

// While poses continue, a frame may end before the previous one, as the slices of its packets do;
// then the stamp stays. If the clock of the poses was unknown or has changed, time continues from
// the present stamp.
void WindowClock::end_frame(std::optional<std::uint64_t> time_us, bool is_anew,
                            std::uint64_t now_us) {
  const std::uint64_t passed_us = stamp_us_ + (now_us - moved_us_);
  if (time_us) {
    const std::uint64_t least_us = had_time_ && !is_anew ? 0 : stamp_us_;
    const std::uint64_t most_us = has_time_ ? passed_us + pose::kMaxLeapUs : ~std::uint64_t{0};
    const std::uint64_t stamp_us = *time_us + offset_us_;
    if (stamp_us < least_us || stamp_us > most_us) {
      offset_us_ = passed_us - *time_us;
    }
    has_time_ = true;
  }
  had_time_ = time_us.has_value();
  const std::uint64_t stamp_us = time_us ? *time_us + offset_us_ : passed_us;
  if (stamp_us > stamp_us_) {
    stamp_us_ = stamp_us;
    moved_us_ = now_us;
  }
}

}  // namespace iog::perception
