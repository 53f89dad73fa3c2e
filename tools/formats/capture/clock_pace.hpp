// Whether the times of a capture pass as the clock of a unit in it does. They do not if they were
// lost, or read in another unit, when the capture was converted.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

#include "tools/formats/capture/capture_clock.hpp"
#include "tools/program/fixed.hpp"

namespace iog::tools {

class ClockPace {
 public:
  // The times of a unit's next packet. Steps of its clock by more than a second are left out.
  void add(std::uint64_t unit_us, std::uint64_t capture_us) {
    const auto step_us = static_cast<std::int64_t>(unit_us - last_unit_us_);
    if (has_started_ && step_us >= -kLongestUs &&
        step_us <= 0) {  // another packet of the same scan
      return;
    }
    if (has_started_ && step_us > 0 && step_us <= kLongestUs) {
      unit_us_ += step_us;
      still_us_ = capture_us == last_capture_us_ ? still_us_ + step_us : 0;
      longest_still_us_ = std::max(longest_still_us_, still_us_);
      capture_us_ +=
          std::clamp(static_cast<std::int64_t>(capture_us - last_capture_us_), 0L, kLongestUs);
    }
    has_started_ = true;
    last_unit_us_ = unit_us;
    last_capture_us_ = capture_us;
  }

  // "they advance by 0.000 s while the clock of roof advances by 9.900 s: ..."; empty if they may
  // be right. Half or twice the pace is wrong, and so are times that stand still for longer than a
  // turn, whose packets share one time in a ROS message.
  [[nodiscard]] std::string words(const std::string& unit) const {
    const bool is_pace_right =
        unit_us_ < kEnoughUs || (2 * capture_us_ > unit_us_ && capture_us_ < 2 * unit_us_);
    if (is_pace_right && longest_still_us_ < kLongStillUs) {
      return {};
    }
    const auto seconds = [](auto us) { return fixed(static_cast<double>(us) / 1e6, 3) + " s"; };
    return "the capture's times are wrong: they " +
           (is_pace_right ? "stand still" : "advance by " + seconds(capture_us_)) +
           " while the clock of " + unit + " advances by " +
           seconds(is_pace_right ? longest_still_us_ : unit_us_) +
           "; convert or record it again, with the time at which each packet came";
  }

 private:
  static constexpr auto kLongestUs = static_cast<std::int64_t>(CaptureClock::kLongestPauseUs);
  static constexpr std::int64_t kEnoughUs = 500'000;
  static constexpr std::int64_t kLongStillUs = 300'000;

  bool has_started_ = false;
  std::uint64_t last_unit_us_ = 0;
  std::uint64_t last_capture_us_ = 0;
  std::int64_t unit_us_ = 0;  // how far each has advanced
  std::int64_t capture_us_ = 0;
  std::int64_t still_us_ = 0;  // since the capture's time has changed
  std::int64_t longest_still_us_ = 0;
};

}  // namespace iog::tools
