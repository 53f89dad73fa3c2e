#include "tools/identity/clock_step.hpp"

#include <algorithm>
#include <cstdlib>

namespace iog::tools {
namespace {

constexpr std::int64_t kLongStepUs = 1'000'000;
constexpr std::int64_t kLeastStepUs = 100'000;
constexpr std::int64_t kStepOverSpread = 4;  // of the leads on each side
constexpr std::int64_t kWindowUs = 500'000;
constexpr std::int64_t kLongWindowUs = 5'000'000;  // windows before a longer one do not count
// Beyond this, 36,000 years, leads are alike. So their differences do not overflow.
constexpr std::int64_t kMostAheadUs = std::int64_t{1} << 60;

}  // namespace

void ClockStep::add(std::int64_t given_us, std::uint64_t capture_us) {
  const std::int64_t ahead_us = std::clamp(given_us, -kMostAheadUs, kMostAheadUs);
  if (!found_) {
    add_long(ahead_us, capture_us);
  }
  if (found_) {
    return;
  }
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
  const bool is_usual = usual_us_ && std::abs(ahead_us - *usual_us_) <= kLongStepUs;
  const bool is_alike = std::abs(ahead_us - row_us_.front()) <= kLongStepUs;
  if (is_usual || (usual_us_ && !is_alike)) {
    row_packets_ = 0;
  }
  if (is_usual) {
    return;
  }
  row_begin_us_ = row_packets_ == 0 ? capture_us : row_begin_us_;
  row_us_[row_packets_++] = ahead_us;
  if (row_packets_ < kPacketsInARow) {
    return;
  }
  const auto middle = row_us_.begin() + kPacketsInARow / 2;
  std::ranges::nth_element(row_us_, middle);
  row_packets_ = 0;
  if (usual_us_) {
    found_ = {.step_us = *middle - *usual_us_, .time_us = row_begin_us_};
  } else {
    usual_us_ = *middle;
  }
}

void ClockStep::close_window() {
  // A slow drift is no step.
  const std::int64_t drift_us = open_->ahead_us - windows_.back().ahead_us;
  if (usual_us_ && windows_.back().begin_us > 0 && std::abs(drift_us) <= kLongStepUs) {
    *usual_us_ += drift_us;
  }
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
  // Long steps are found by add_long(), but for those of about a second.
  if (std::abs(step_us) <= kLeastStepUs || std::abs(step_us) > 2 * kLongStepUs ||
      spread_us > std::abs(step_us) / kStepOverSpread) {
    return;
  }
  const Window& middle = windows_[kSide];
  const bool is_after = std::abs(middle.ahead_us - after_most) < std::abs(middle.ahead_us - most);
  found_ = {.step_us = step_us,
            .time_us = is_after ? middle.begin_us : windows_[kSide + 1].begin_us};
}

}  // namespace iog::tools
