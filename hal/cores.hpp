// Hardware interface for the other cores, called helpers. Core 0 controls them.
//
// A helper sleeps until it is woken, does its job once, and sleeps again. It never gives up a job
// by itself; core 0 watches the time and stops it.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::hal {

inline constexpr std::size_t kMaxCores = 4;

// The job of a helper each time it is woken.
struct CoreJob {
  void (*run)(void* context, std::size_t core) = nullptr;
  void* context = nullptr;
};

enum class CoreState : std::uint8_t {
  kOff,      // never started, or failed to start
  kRunning,  // sleeping or doing its job
  kFaulted,  // ended by an exception or a failed requirement; stores nothing any more
  kStopped,  // ended by stop(); stores nothing any more
};

// count():           cores of the machine, core 0 included: 1 to kMaxCores.
// start(core, job):  starts a helper, 1 to count() - 1, and waits until it is up, at most 100 ms.
//                    Returns false if it is not. The job and its context must outlive the helper.
// state(core):       the helper's state. Everything that it stored before it ended is then visible
//                    to core 0.
// wake(core):        the helper does its job at least once, starting after this call. Everything
// that
//                    core 0 stored before is then visible to the helper.
// stop(core):        ends a helper at any point, and waits until it has ended, at most 100 ms.
//                    Returns false if it has not; it may then still store.
// last_word(core):   why and where a helper ended, as text for people. Otherwise empty.
// now_us():          the clock that bounds all waits.
// pause():           a short rest in a loop that waits for another core.
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
