// The cores of the tests (hal/cores.hpp): each helper is a thread of the PC.
//
// A test may let a helper fault or hang, at either end of its job or from within it. Who hangs
// stands still until it is stopped, and is gone then without another store, as a core is.
#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <string_view>
#include <thread>

#include "hal/cores.hpp"

namespace iog::tests {

class ThreadCores {
 public:
  enum class Phase : std::uint8_t { kNever, kStart, kAwake, kLeft };

  explicit ThreadCores(std::size_t count) : count_(count) {}
  ThreadCores(const ThreadCores&) = delete;
  ThreadCores& operator=(const ThreadCores&) = delete;
  ~ThreadCores() {
    for (Helper& helper : helpers_) {
      if (helper.thread.joinable()) {
        ask_to_end(helper);
        helper.thread.join();
      }
    }
  }

  // From then on the helper hangs there, or does not come up; kNever lets it go on.
  void hang_at(std::size_t core, Phase phase) { helpers_[core].hangs_at = phase; }

  // For an item: which core does it; that this core ends here, or stands still here. Core 0 cannot.
  [[nodiscard]] static std::size_t current() { return current_core(); }
  [[noreturn]] void fault() { end(hal::CoreState::kFaulted); }
  [[noreturn]] void hang() {
    while (!helpers_[current()].is_ending) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    end(hal::CoreState::kStopped);
  }

  [[nodiscard]] std::size_t count() const { return count_; }

  bool start(std::size_t core, hal::CoreJob job) {
    Helper& helper = helpers_[core];
    if (helper.hangs_at == Phase::kStart) {
      return false;
    }
    helper.job = job;
    helper.state = hal::CoreState::kRunning;
    helper.thread = std::thread([this, core] { live(core); });
    return true;
  }

  [[nodiscard]] hal::CoreState state(std::size_t core) const { return helpers_[core].state; }

  void wake(std::size_t core) {
    Helper& helper = helpers_[core];
    const std::lock_guard lock(helper.mutex);
    ++helper.wakes;
    helper.is_woken.notify_one();
  }

  bool stop(std::size_t core) {
    Helper& helper = helpers_[core];
    ask_to_end(helper);
    for (int waits = 0; waits < 100'000 && helper.state == hal::CoreState::kRunning; ++waits) {
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
    return helper.state != hal::CoreState::kRunning;
  }

  [[nodiscard]] std::string_view last_word(std::size_t /*core*/) const { return "ended"; }

  std::uint64_t now_us() {
    const auto since = std::chrono::steady_clock::now().time_since_epoch();
    return static_cast<std::uint64_t>(
        std::chrono::duration_cast<std::chrono::microseconds>(since).count());
  }

  void pause() { std::this_thread::yield(); }

 private:
  struct Helper {
    std::thread thread;
    std::mutex mutex;
    std::condition_variable is_woken;
    std::uint32_t wakes = 0;
    std::atomic<bool> is_ending = false;
    std::atomic<Phase> hangs_at = Phase::kNever;
    std::atomic<hal::CoreState> state = hal::CoreState::kOff;
    hal::CoreJob job;
    std::jmp_buf way_out;
  };

  static std::size_t& current_core() {
    static thread_local std::size_t core = 0;
    return core;
  }

  static void ask_to_end(Helper& helper) {
    const std::lock_guard lock(helper.mutex);
    helper.is_ending = true;
    helper.is_woken.notify_one();
  }

  // Leaves the job where it is. No object that the job left is destroyed.
  [[noreturn]] void end(hal::CoreState state) {
    std::longjmp(helpers_[current()].way_out, static_cast<int>(state));
  }

  void live(std::size_t core) {
    Helper& helper = helpers_[core];
    current_core() = core;
    const int ended = setjmp(helper.way_out);
    if (ended == 0) {
      while (sleep(helper)) {
        hang_if(helper, Phase::kAwake);
        helper.job.run(helper.job.context, core);
        hang_if(helper, Phase::kLeft);
      }
      helper.state = hal::CoreState::kStopped;
    } else {
      helper.state = static_cast<hal::CoreState>(ended);
    }
  }

  // Until it is woken; false when it is to end.
  static bool sleep(Helper& helper) {
    std::unique_lock lock(helper.mutex);
    helper.is_woken.wait(lock, [&] { return helper.wakes > 0 || helper.is_ending; });
    helper.wakes = 0;
    return !helper.is_ending;
  }

  void hang_if(const Helper& helper, Phase phase) {
    while (helper.hangs_at == phase) {
      if (helper.is_ending) {
        end(hal::CoreState::kStopped);
      }
      std::this_thread::sleep_for(std::chrono::microseconds(50));
    }
  }

  std::size_t count_;
  std::array<Helper, hal::kMaxCores> helpers_;
};

static_assert(hal::Cores<ThreadCores>);

}  // namespace iog::tests
