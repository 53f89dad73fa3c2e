// Whether a clock in a capture was set while it was recorded, as a lidar's by PPS or PTP.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace iog::tools {

// Of one clock beside the capture's. Packets come late, in batches or not at all, but of half a
// second at least one comes without delay: in each window the greatest lead is the clock's.
class ClockStep {
 public:
  struct Found {
    std::int64_t step_us = 0;
    std::uint64_t time_us = 0;  // of the capture
  };

  // The next packet: how far its own time is ahead of the capture's.
  void add(std::int64_t ahead_us, std::uint64_t capture_us);

  // The first step by more than 0.1 s between 1.5 s without one; by more than a second, the
  // step from the first packets that 25 packets in a row agree on.
  [[nodiscard]] const std::optional<Found>& found() const { return found_; }

 private:
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
  std::size_t closed_ = 0;                  // of them are filled
  std::optional<Window> open_;
  std::int64_t first_ahead_us_ = 0;
  std::size_t first_packets_ = 0;
  Found long_{};
  std::size_t long_packets_ = 0;  // in a row that are so much off
};

}  // namespace iog::tools
