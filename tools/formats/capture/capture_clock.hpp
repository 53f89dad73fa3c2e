// The clock of a capture. It starts at 0 with the first packet and never runs backwards. A pause
// lasts at most a second, so that a strange capture makes neither millions of empty frames nor a
// replay of days.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>

namespace iog::tools {

// The times of a recording whose clock was set while it ran. After a step back they continue from
// where they were, after the same gap as between the two packets before. Small disorder stays, as
// between several interfaces or processors. If interfaces disagree by more, which looks like steps
// to and fro, each continues from its own last time.
class SteadyTime {
 public:
  static constexpr std::int64_t kMostDisorderUs = 50'000;

  // recorded_us: the next packet's time in the recording. Returns it without the steps.
  std::uint64_t of(std::uint64_t recorded_us);

  // "its clock steps back 2 times, 3.000 s at most; ..."; empty if there is nothing to say.
  [[nodiscard]] std::string words() const;

 private:
  struct Steps {
    std::uint64_t count = 0;
    std::int64_t longest_us = 0;
    void add(std::int64_t step_us);
    [[nodiscard]] std::string words() const;
  };

  bool has_started_ = false;
  std::int64_t newest_us_ = 0;
  std::int64_t gap_us_ = 0;           // between the last two packets
  std::int64_t added_us_ = 0;         // to what is recorded
  std::int64_t added_before_us_ = 0;  // until the last step
  Steps back_;
  Steps ahead_;
};

class CaptureClock {
 public:
  static constexpr std::uint64_t kLongestPauseUs = 1'000'000;

  // Moves on to a packet with this time stamp. Returns its time in microseconds since the start.
  std::uint64_t move_to(std::uint64_t capture_us) {
    if (has_started_ && capture_us > last_capture_us_) {
      now_us_ += std::min(capture_us - last_capture_us_, kLongestPauseUs);
    }
    last_capture_us_ = has_started_ ? std::max(last_capture_us_, capture_us) : capture_us;
    has_started_ = true;
    return now_us_;
  }

 private:
  bool has_started_ = false;
  std::uint64_t last_capture_us_ = 0;
  std::uint64_t now_us_ = 0;
};

}  // namespace iog::tools
