// Collects time statistics of the loop since start-up. The statistics cover the duration of each
// stage of a frame, how long after its deadline each frame is closed, and how long each core works
// per frame. For frames without packets, only the working times of the cores are counted. Each new
// maximum is written to the console, for example as "worst publish 12345 us".
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "app/platform.hpp"
#include "hal/console.hpp"
#include "hal/cores.hpp"
#include "health/durations.hpp"
#include "stream/message.hpp"
#include "work/core_times.hpp"

namespace iog::app {

class LoopTimes {
 public:
  // The rows are in the same order as Counts::kNames.
  enum Row : std::uint8_t { kFuse, kMark, kPublish, kPerceive, kFrame, kLate, kCore0 };
  static constexpr std::size_t kRows = kCore0 + hal::kMaxCores;

  // Call this function once per frame. `ticks_hz` is the frequency of the stopwatch. If ticks_hz is
  // 0, all times are 0.
  void add(const FrameTimes& frame, const work::CoreTimes& cores, std::uint32_t ticks_hz) {
    const auto us = [ticks_hz](std::uint64_t ticks) {
      constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
      const std::uint64_t micros = ticks_hz == 0 ? 0 : ticks * 1'000'000 / ticks_hz;
      return static_cast<std::uint32_t>(std::min(micros, kMost));
    };
    const stream::StageTicks& ticks = frame.ticks;
    if (before_) {
      counts_.rows[kPublish].add(us(ticks.publish));
      counts_.rows[kFrame].add(us(*before_ + ticks.publish));
      before_.reset();
    }
    for (std::size_t core = 0; core < hal::kMaxCores; ++core) {
      const std::uint32_t worked = cores.ticks(core) - worked_[core];
      worked_[core] += worked;
      if (worked != 0) {
        counts_.rows[kCore0 + core].add(us(worked));
      }
    }
    if (!frame.has_packets) {
      return;
    }
    before_ = std::uint64_t{ticks.fuse} + ticks.mark + ticks.perceive;
    counts_.rows[kFuse].add(us(ticks.fuse));
    counts_.rows[kMark].add(us(ticks.mark));
    counts_.rows[kPerceive].add(us(ticks.perceive));
    counts_.rows[kLate].add(frame.late_us);
  }

  struct Counts {
    std::array<health::Durations, kRows> rows{};
    // The names that the stream uses for the rows (stream/target_table.hpp).
    static constexpr auto kNames =
        std::to_array<std::string_view>({"fuse", "mark", "publish", "perceive", "frame", "late",
                                         "core 0", "core 1", "core 2", "core 3"});
  };
  [[nodiscard]] const Counts& counts() const { return counts_; }

  // Writes at most one line per second. A line fits into the transmit buffer of the serial port, so
  // writing does not block. Call this function when no work is pending.
  template <hal::Console Console>
  void tell(std::uint64_t now_us, Console& console) {
    if (now_us - told_at_us_ < kTellEveryUs) {
      return;
    }
    told_at_us_ = now_us;
    for (std::size_t row = 0; row < kRows; ++row) {
      if (counts_.rows[row].worst_us > told_us_[row]) {
        told_us_[row] = counts_.rows[row].worst_us;
        console.write("worst ");
        console.write(Counts::kNames[row]);
        console.write(" ");
        write(told_us_[row], console);
        console.write(" us\n");
        return;
      }
    }
  }

 private:
  static constexpr std::uint64_t kTellEveryUs = 1'000'000;

  template <hal::Console Console>
  static void write(std::uint32_t number, Console& console) {
    std::array<char, 10> digits{};
    std::size_t first = digits.size();
    do {
      digits[--first] = static_cast<char>('0' + number % 10);
      number /= 10;
    } while (number != 0);
    console.write(std::string_view(digits.data() + first, digits.size() - first));
  }

  Counts counts_{};
  std::array<std::uint32_t, kRows> told_us_{};
  std::uint64_t told_at_us_ = 0;
  std::array<std::uint32_t, hal::kMaxCores> worked_{};
  std::optional<std::uint64_t> before_;  // ticks of the previous frame without publishing
};

}  // namespace iog::app
