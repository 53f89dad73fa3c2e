// What the loop has measured of itself since its start: what the stages of a frame took, how late
// frames were closed, and what each core did for a frame. Of frames with packets; silence is cheap.
//
// A stage costs two readings of the stopwatch, a frame some divisions (docs/safety.md).
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>

#include "app/platform.hpp"
#include "hal/cores.hpp"
#include "health/durations.hpp"
#include "stream/message.hpp"
#include "work/core_times.hpp"

namespace iog::app {

class LoopTimes {
 public:
  // In the order of Counts::kNames.
  enum Row : std::uint8_t { kFuse, kMark, kPublish, kPerceive, kFrame, kLate, kCore0 };
  static constexpr std::size_t kRows = kCore0 + hal::kMaxCores;

  // Once for each frame. ticks_hz: of the stopwatch; 0 counts as no time.
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
    // In the stream (stream/target_table.hpp).
    static constexpr auto kNames =
        std::to_array<std::string_view>({"fuse", "mark", "publish", "perceive", "frame", "late",
                                         "core 0", "core 1", "core 2", "core 3"});
  };
  [[nodiscard]] const Counts& counts() const { return counts_; }

  // A row that has become worse since it was last told, if there is one.
  struct News {
    std::string_view name;
    std::uint32_t worst_us = 0;
  };
  [[nodiscard]] std::optional<News> news() {
    for (std::size_t row = 0; row < kRows; ++row) {
      if (counts_.rows[row].worst_us > told_us_[row]) {
        told_us_[row] = counts_.rows[row].worst_us;
        return News{.name = Counts::kNames[row], .worst_us = told_us_[row]};
      }
    }
    return std::nullopt;
  }

 private:
  Counts counts_{};
  std::array<std::uint32_t, kRows> told_us_{};
  std::array<std::uint32_t, hal::kMaxCores> worked_{};
  std::optional<std::uint64_t> before_;  // ticks of the frame before, without publishing it
};

}  // namespace iog::app
