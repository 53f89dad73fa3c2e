#include "tools/identity/clock_step.hpp"

#include <algorithm>
#include <cstdlib>

namespace iog::tools {
namespace {

constexpr std::size_t kPacketsInARow = 25;  // packets: one may be damaged
constexpr std::int64_t kLongStepUs = 1'000'000;
constexpr std::int64_t kLeastStepUs = 100'000;
constexpr std::int64_t kSteadierThanStep = 4;  // each side is steadier than this part of the step
constexpr std::int64_t kWindowUs = 500'000;
constexpr std::int64_t kLongWindowUs = 5'000'000;  // clocks drift in longer ones

}  // namespace

void ClockStep::add(std::int64_t ahead_us, std::uint64_t capture_us) {
  if (found_) {
    return;
  }
  add_long(ahead_us, capture_us);
  const auto lasts_us =
      static_cast<std::int64_t>(capture_us - (open_ ? open_->begin_us : capture_us));
  if (std::abs(lasts_us) >= kWindowUs) {  // packets may change places
    closed_ = std::abs(lasts_us) < kLongWindowUs ? closed_ : 0;
    close_window();
  }
  open_ = open_
              ? Window{.begin_us = open_->begin_us, .ahead_us = std::max(open_->ahead_us, ahead_us)}
              : Window{.begin_us = capture_us, .ahead_us = ahead_us};
}

void ClockStep::add_long(std::int64_t ahead_us, std::uint64_t capture_us) {
  if (first_packets_ < kPacketsInARow) {
    first_ahead_us_ = first_packets_++ == 0 ? ahead_us : first_ahead_us_;
    return;
  }
  const std::int64_t off_us = ahead_us - first_ahead_us_;
  if (long_packets_ == 0 || std::abs(off_us - long_.step_us) > kLongStepUs) {
    long_ = {.step_us = off_us, .time_us = capture_us};
    long_packets_ = 0;
  }
  long_packets_ = std::abs(off_us) > kLongStepUs ? long_packets_ + 1 : 0;
  if (long_packets_ == kPacketsInARow) {
    found_ = long_;
  }
}

void ClockStep::close_window() {
  std::shift_left(windows_.begin(), windows_.end(), 1);
  windows_.back() = *open_;
  open_.reset();
  closed_ = std::min(closed_ + 1, kWindows);
  if (closed_ < kWindows) {
    return;
  }
  const auto [least, most] =
      std::minmax({windows_[0].ahead_us, windows_[1].ahead_us, windows_[2].ahead_us});
  const auto [after_least, after_most] =
      std::minmax({windows_[4].ahead_us, windows_[5].ahead_us, windows_[6].ahead_us});
  const std::int64_t step_us = (after_least + after_most) / 2 - (least + most) / 2;
  const std::int64_t spread_us = std::max(most - least, after_most - after_least);
  if (std::abs(step_us) <= kLeastStepUs || std::abs(step_us) > kLongStepUs ||
      kSteadierThanStep * spread_us > std::abs(step_us)) {
    return;
  }
  const Window& middle = windows_[kSide];
  const bool is_after = std::abs(middle.ahead_us - after_most) < std::abs(middle.ahead_us - most);
  found_ = {.step_us = step_us,
            .time_us = is_after ? middle.begin_us : windows_[kSide + 1].begin_us};
}

}  // namespace iog::tools
