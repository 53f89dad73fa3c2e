// The seam to the machine's other cores, the helpers. Core 0 is the one that asks.
//
// A helper sleeps until it is woken, then does its job once, and sleeps again. It never gives up by
// itself what it has begun; core 0 watches the time and stops it.
#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace iog::hal {

inline constexpr std::size_t kMaxCores = 4;

// What a helper does each time it is woken.
struct CoreJob {
  void (*run)(void* context, std::size_t core) = nullptr;
  void* context = nullptr;
};

enum class CoreState : std::uint8_t {
  kOff,      // never started, or it did not come up
  kRunning,  // sleeps or does its job
  kFaulted,  // an exception or a broken requirement ended it; it stores nothing any more
  kStopped,  // stop() ended it; it stores nothing any more
};

// count():           cores the machine has, core 0 included: 1 to kMaxCores.
// start(core, job):  starts a helper, 1 to count() - 1, and waits until it is up, at most 100 ms.
//                    Whether it is. The job and its context outlive the helper.
// state(core):       of a helper, now. What it stored before it ended is then visible to core 0.
// wake(core):        the helper does its job at least once that begins after this. What core 0
//                    has stored before is then visible to it.
// stop(core):        ends a helper wherever it is, and waits until it has ended, at most 100 ms.
//                    Whether it has; if not, it may still store.
// last_word(core):   of a helper that has ended, for a person: why and where. Else empty.
// now_us():          the time by which waits are bounded.
// pause():           a moment's rest in a loop that waits for another core.
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
