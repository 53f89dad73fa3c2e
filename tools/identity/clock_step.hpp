// Detects that a clock was set during a recording, such as a lidar's by PPS or PTP.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace iog::tools {

// Compares one clock with the capture's. Packets are delayed, batched or lost, but at least one in
// half a second comes without delay: the greatest lead in each window is the clock's.
class ClockStep {
 public:
  struct Found {
    std::int64_t step_us = 0;   // positive if the clock was set forward
    std::uint64_t time_us = 0;  // of the capture, to about half a second
  };

  // Takes the next packet. `ahead_us` is how far its own time is ahead of the capture's. Times of
  // the capture may go back.
  void add(std::int64_t ahead_us, std::uint64_t capture_us);

  // Returns the first step: by more than 0.1 s, with 1.5 s of steady time on both sides; or by more
  // than a second, in 25 successive packets.
  [[nodiscard]] const std::optional<Found>& found() const { return found_; }

 private:
  static constexpr std::size_t kPacketsInARow = 25;       // one may be damaged
  static constexpr std::size_t kSide = 3;                 // windows before a step, and after it
  static constexpr std::size_t kWindows = 2 * kSide + 1;  // the step is in the middle one
  struct Window {
    std::uint64_t begin_us = 0;
    std::int64_t ahead_us = 0;
  };

  void add_long(std::int64_t ahead_us, std::uint64_t capture_us);
  void close_window();

  std::optional<Found> found_;
  std::array<Window, kWindows> windows_{};  // the newest last
  std::size_t closed_ = 0;                  // the number of filled windows
  std::optional<Window> open_;
  std::optional<std::int64_t> usual_us_;  // the lead before a long step; follows a slow drift
  std::array<std::int64_t, kPacketsInARow> row_us_{};  // of the first packets, then of such a step
  std::uint64_t row_begin_us_ = 0;
  std::size_t row_packets_ = 0;
};

}  // namespace iog::tools
