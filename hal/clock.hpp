// Hardware interface for time: a clock for points in time, a stopwatch for short durations.
#pragma once

#include <concepts>
#include <cstdint>

namespace iog::hal {

// now_us():  microseconds since start, monotonic, does not wrap within the life of a car.
template <typename T>
concept Clock = requires(T& clock) {
  { clock.now_us() } -> std::same_as<std::uint64_t>;
};

// A free-running 32-bit counter for measuring stages of some microseconds. ticks() wraps; the
// difference of two readings less than one wrap apart is exact. ticks_hz() is its measured rate.
template <typename T>
concept Stopwatch = requires(const T& stopwatch) {
  { stopwatch.ticks() } -> std::same_as<std::uint32_t>;
  { stopwatch.ticks_hz() } -> std::same_as<std::uint32_t>;
};

}  // namespace iog::hal
