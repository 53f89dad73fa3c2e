// Hardware interface for time: a clock for timestamps and a stopwatch for short durations.
#pragma once

#include <concepts>
#include <cstdint>

namespace iog::hal {

// `now_us()` returns the microseconds since start. The clock is monotonic and does not wrap during
// the lifetime of a car.
template <typename T>
concept Clock = requires(T& clock) {
  { clock.now_us() } -> std::same_as<std::uint64_t>;
};

// A free-running 32-bit counter for timing stages that take a few microseconds. `ticks()` wraps.
// The difference of two readings is exact if the readings are less than one wrap apart.
// `ticks_hz()` returns the measured tick rate.
template <typename T>
concept Stopwatch = requires(const T& stopwatch) {
  { stopwatch.ticks() } -> std::same_as<std::uint32_t>;
  { stopwatch.ticks_hz() } -> std::same_as<std::uint32_t>;
};

}  // namespace iog::hal
