// What the target's loop has measured of itself, as the link counters say it (docs/spec.md 3.7).
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "health/durations.hpp"
#include "stream/message.hpp"

namespace iog::tools {

// How long one thing took, since the target's start.
struct LoopTime {
  std::uint32_t worst_us = 0;
  std::uint64_t sum_us = 0;
  std::array<std::uint32_t, health::Durations::kBuckets> counts{};

  [[nodiscard]] std::uint64_t count() const;
  [[nodiscard]] double mean_us() const;
  friend bool operator==(const LoopTime&, const LoopTime&) = default;
};

// In the order of docs/spec.md.
inline constexpr std::array<std::string_view, stream::kTimeRows> kLoopTimeNames{
    "fuse", "mark", "publish", "perceive", "frame", "late", "core 0", "core 1", "core 2", "core 3"};
using LoopTimes = std::array<LoopTime, stream::kTimeRows>;

// Empty if the target does not say it: a PC, or an older one.
[[nodiscard]] std::optional<LoopTimes> loop_times_of(const stream::FrameEnd& end);

// "2310 us mean, 4120 worst, of 250: 3 % < 2048, 96 % < 4096, 1 % < 8192".
[[nodiscard]] std::string words_of(const LoopTime& time);

}  // namespace iog::tools
