// Hardware interface for the other cores, called helpers. Core 0 controls them.
//
// A helper sleeps until it is woken, runs its job once, and goes back to sleep. A helper never
// abandons a job. Core 0 enforces the time limit and stops the helper.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::hal {

inline constexpr std::size_t kMaxCores = 4;

// The job that a helper runs each time it is woken.
struct CoreJob {
  void (*run)(void* context, std::size_t core) = nullptr;
  void* context = nullptr;
};

enum class CoreState : std::uint8_t {
  kOff,      // never started, or failed to start
  kRunning,  // sleeping or doing its job
  kFaulted,  // ended by an exception or a failed requirement; writes no more memory
  kStopped,  // ended by stop(); writes no more memory
};

// `count()` returns the number of cores of the machine, 1 to kMaxCores, including core 0.
// `start(core, job)` starts helper `core`, 1 to count() - 1, and waits at most 100 ms until the
// helper is running. `start()` returns false if the helper is not running by then. The job and its
// context must outlive the helper. `state(core)` returns the state of the helper. If the helper has
// ended, core 0 sees all stores that the helper made before it ended. `wake(core)` makes the helper
// run its job at least once, starting after this call. The helper sees all stores that core 0 made
// before this call. `stop(core)` ends a helper at any point, and waits at most 100 ms until the
// helper has ended. `stop()` returns false if the helper has not ended. In this case, the helper
// may still write memory. `last_word(core)` returns the reason and the location at which a helper
// ended, as human-readable text. The text is empty if the helper has not ended. `now_us()` returns
// the time of the clock that bounds all waits. `pause()` makes a short pause in a loop that waits
// for another core.
template <typename T>
concept Cores = requires(T& cores, const T& view, std::size_t core, CoreJob job) {
  { view.count() } -> std::same_as<std::size_t>;
  { cores.start(core, job) } -> std::same_as<bool>;
  { view.state(core) } -> std::same_as<CoreState>;
  { cores.wake(core) } -> std::same_as<void>;
  { cores.stop(core) } -> std::same_as<bool>;
  { view.last_word(core) } -> std::same_as<std::string_view>;
  { cores.now_us() } -> std::same_as<std::uint64_t>;
  { cores.pause() } -> std::same_as<void>;
};

}  // namespace iog::hal
