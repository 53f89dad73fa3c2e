#include "tools/formats/capture/capture_clock.hpp"

#include <cstdlib>
#include <utility>

#include "tools/program/fixed.hpp"

namespace iog::tools {

void SteadyTime::Steps::add(std::int64_t step_us) {
  ++count;
  longest_us = std::max(longest_us, step_us);
}

std::string SteadyTime::Steps::words() const {
  return (count == 1 ? "once" : std::to_string(count) + " times") + ", by " +
         fixed(static_cast<double>(longest_us) / 1e6, 3) + (count == 1 ? " s" : " s at most");
}

std::uint64_t SteadyTime::of(std::uint64_t recorded_us) {
  const auto recorded = static_cast<std::int64_t>(recorded_us);
  if (!std::exchange(has_started_, true)) {
    newest_us_ = recorded;
  }
  std::int64_t step_us = recorded + added_us_ - newest_us_;
  const std::int64_t step_before_us = recorded + added_before_us_ - newest_us_;
  if (step_before_us >= -kMostDisorderUs && std::abs(step_before_us) < std::abs(step_us)) {
    std::swap(added_us_, added_before_us_);
    step_us = step_before_us;
  } else if (step_us < -kMostDisorderUs) {
    back_.add(gap_us_ - step_us);
    added_before_us_ = std::exchange(added_us_, newest_us_ + gap_us_ - recorded);
    step_us = gap_us_;
  }
  gap_us_ = step_us >= 0 && step_us <= kMostDisorderUs ? step_us : gap_us_;
  if (step_us > static_cast<std::int64_t>(CaptureClock::kLongestPauseUs)) {
    ahead_.add(step_us - gap_us_);
  }
  const std::int64_t now_us = newest_us_ + step_us;
  newest_us_ = std::max(newest_us_, now_us);
  return static_cast<std::uint64_t>(now_us);
}

std::string SteadyTime::words() const {
  std::string text;
  if (back_.count > 0) {
    constexpr std::uint64_t kDisorder = 20;
    text = "its clock steps back " + back_.words() + "; its times go on from there" +
           (back_.count < kDisorder ? ""
                                    : ": if packets are out of order, sort the capture with "
                                      "reordercap");
  }
  if (ahead_.count > 0) {
    text += (text.empty() ? "" : "; ") +
            ("nothing comes for more than 1 s, or its clock steps ahead, " + ahead_.words());
  }
  return text;
}

}  // namespace iog::tools
