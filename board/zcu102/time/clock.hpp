// Reads time from the generic timer, at the frequency that the boot loader has set.
#pragma once

#include "hal/clock.hpp"
#include "machine.hpp"

namespace iog::zcu102 {

// Returns microseconds since the counter started. The counter starts before the firmware. The class
// satisfies hal::Clock.
class Clock {
 public:
  std::uint64_t now_us() {
    const std::uint64_t ticks = machine::counter();
    return ticks / hz_ * 1'000'000 + ticks % hz_ * 1'000'000 / hz_;
  }

 private:
  std::uint64_t hz_ = machine::counter_hz();
};
static_assert(hal::Clock<Clock>);

// Reads the same counter for short durations. The class satisfies hal::Stopwatch.
class Stopwatch {
 public:
  std::uint32_t ticks() const { return static_cast<std::uint32_t>(machine::counter()); }
  std::uint32_t ticks_hz() const { return static_cast<std::uint32_t>(machine::counter_hz()); }
};
static_assert(hal::Stopwatch<Stopwatch>);

}  // namespace iog::zcu102
