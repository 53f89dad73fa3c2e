// A drive for the tests of the history: the messages of a source that drives straight on along x.
#pragma once

#include <cstdint>
#include <gtest/gtest.h>

#include "pose/history.hpp"

namespace iog::pose::testing {

inline constexpr std::uint64_t kStartUs = 5'000'000;
inline constexpr std::int32_t kSpeedMmPerS = 10'000;

// The message at a time: x is 0 at kStartUs.
inline Message message_at(std::uint64_t clock_us, std::uint32_t run = 1) {
  const auto since_us = static_cast<std::int64_t>(clock_us - kStartUs);
  return {.run = run,
          .clock_us = clock_us,
          .pose = {.x_mm = static_cast<std::int32_t>(since_us / 100), .y_mm = 0, .heading = 0},
          .sigma = {10, 10},
          .speed_mm_per_s = kSpeedMmPerS};
}

// Messages every period from kStartUs, the last one at or before end_us.
inline void drive(History& history, std::uint64_t end_us, std::uint64_t period_us = 10'000) {
  for (std::uint64_t clock_us = kStartUs; clock_us <= end_us; clock_us += period_us) {
    static_cast<void>(history.add(message_at(clock_us), clock_us));
  }
}

// The three messages, 10 ms apart, by which a run is believed that goes on where another was.
inline void go_on_as(History& history, std::uint32_t run, std::uint64_t since_us) {
  for (std::uint64_t i = 1; i <= 3; ++i) {
    const Message message = message_at(since_us + i * 10'000, run);
    static_cast<void>(history.add(message, message.clock_us));
  }
}

// A source that has sent `count` messages, 10 ms apart.
struct Driven {
  explicit Driven(std::uint64_t count = 50) : newest_us(kStartUs + (count - 1) * 10'000) {
    drive(history, newest_us);
  }

  Fate take(const Message& message) { return history.add(message, message.clock_us); }
  Fate take_at(std::uint64_t clock_us) { return take(message_at(clock_us)); }
  [[nodiscard]] Cause cause_at(std::uint64_t time_us) const {
    return history.pose_at(time_us).cause;
  }

  History history;
  std::uint64_t newest_us;
};

}  // namespace iog::pose::testing
