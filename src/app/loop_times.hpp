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
#include <span>
#include <string_view>

#include "app/platform.hpp"
#include "hal/cores.hpp"
#include "health/durations.hpp"
#include "stream/message.hpp"
#include "work/core_times.hpp"

namespace iog::app {

class LoopTimes {
 public:
  // In the order of docs/spec.md 3.7, and behind them those of the cores.
  enum Row : std::uint8_t { kFuse, kMark, kPublish, kPerceive, kFrame, kLate, kCore0 };
  static constexpr std::size_t kRows = stream::kTimeRows;
  static_assert(kRows == kCore0 + hal::kMaxCores);

  // Once for each frame. ticks_hz: of the stopwatch; 0 counts as no time.
  void add(const FrameTimes& frame, const work::CoreTimes& cores, std::uint32_t ticks_hz) {
    const auto us = [ticks_hz](std::uint64_t ticks) {
      constexpr std::uint64_t kMost = std::numeric_limits<std::uint32_t>::max();
      const std::uint64_t micros = ticks_hz == 0 ? 0 : ticks * 1'000'000 / ticks_hz;
      return static_cast<std::uint32_t>(std::min(micros, kMost));
    };
    const stream::StageTicks& ticks = frame.ticks;
    if (before_) {
      rows_[kPublish].add(us(ticks.publish));
      rows_[kFrame].add(us(*before_ + ticks.publish));
      before_.reset();
    }
    for (std::size_t core = 0; core < hal::kMaxCores; ++core) {
      const std::uint32_t worked = cores.ticks(core) - worked_[core];
      worked_[core] += worked;
      if (worked != 0) {
        rows_[kCore0 + core].add(us(worked));
      }
    }
    if (!frame.has_packets) {
      return;
    }
    before_ = std::uint64_t{ticks.fuse} + ticks.mark + ticks.perceive;
    rows_[kFuse].add(us(ticks.fuse));
    rows_[kMark].add(us(ticks.mark));
    rows_[kPerceive].add(us(ticks.perceive));
    rows_[kLate].add(frame.late_us);
  }

  // The first so many counters of `out` become those of the rows.
  static constexpr std::size_t kCounters = kRows * stream::kTimeRowCounters;
  void write(std::span<std::uint32_t, kCounters> out) const {
    std::size_t at = 0;
    for (const health::Durations& row : rows_) {
      out[at++] = row.worst_us();
      out[at++] = static_cast<std::uint32_t>(row.sum_us() >> 32);
      out[at++] = static_cast<std::uint32_t>(row.sum_us());
      for (const std::uint32_t count : row.counts()) {
        out[at++] = count;
      }
    }
  }
  static_assert(stream::kTimeRowCounters == 3 + health::Durations::kBuckets);

  // A row that has become worse since it was last told, if there is one.
  struct News {
    std::string_view name;
    std::uint32_t worst_us = 0;
  };
  [[nodiscard]] std::optional<News> news() {
    for (std::size_t row = 0; row < kRows; ++row) {
      if (rows_[row].worst_us() > told_us_[row]) {
        told_us_[row] = rows_[row].worst_us();
        return News{.name = kNames[row], .worst_us = told_us_[row]};
      }
    }
    return std::nullopt;
  }

 private:
  static constexpr std::array<std::string_view, kRows> kNames{
      "fuse", "mark",   "publish", "perceive", "frame",
      "late", "core 0", "core 1",  "core 2",   "core 3"};

  std::array<health::Durations, kRows> rows_{};
  std::array<std::uint32_t, kRows> told_us_{};
  std::array<std::uint32_t, hal::kMaxCores> worked_{};
  std::optional<std::uint64_t> before_;  // ticks of the frame before, without publishing it
};

}  // namespace iog::app
